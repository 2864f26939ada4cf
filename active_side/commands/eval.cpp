// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "commands/command.hpp"
#include "commands/eval_rigs.hpp"
#include "commands/face_option.hpp"
#include "commands/utc_now.hpp"
#include "eval/error_table.hpp"
#include "eval/touch_eval.hpp"
#include "eval_face/eval_face.hpp"
#include "eval_report/html_report.hpp"
#include "eval_report/make_report.hpp"

namespace telehug {
namespace {

struct TouchOptions {
  EvalTouchOptions eval;
  bool beside_thesis = false;
  std::string report;
};

// That the thesis' way does not work on a recording is a result, not a failure.
std::optional<Result<EvalTouchReport>> thesis_beside(const TouchOptions& options) {
  if (!options.beside_thesis) return std::nullopt;
  EvalTouchOptions same_pictures = options.eval;
  same_pictures.algorithm = thesis_algorithm;
  same_pictures.failure_pictures = false;
  same_pictures.out.clear();
  same_pictures.calibration.clear();
  auto thesis = eval_touch(same_pictures);
  fmt::print("\n{}", thesis ? format_error_table(*thesis)
                            : fmt::format("the thesis' algorithm can't be calibrated: {}\n", thesis.error().message));
  return thesis;
}

ExitCode evaluate_touch(TouchOptions options) {
  options.eval.failure_pictures = !options.report.empty();
  const auto evaluated = eval_touch(options.eval);
  if (!evaluated) return fail(ExitCode::device, evaluated.error());
  for (const std::string& picture : evaluated->part.unreadable)
    fmt::print(stderr, "telehug-active: {}\n", picture);
  fmt::print("{}", format_error_table(*evaluated));
  const auto thesis = thesis_beside(options);
  if (options.report.empty()) return ExitCode::ok;
  const Status written = write_html_report(options.report, report_of(*evaluated, thesis, utc_now()));
  return written ? ExitCode::ok : fail(ExitCode::device, written.error());
}

struct FaceOptions {
  std::string folder;
  std::string out;
  std::string finder = "blaze";
};

ExitCode evaluate_face(const FaceOptions& options) {
  const auto finder = chosen_face_finder(options.finder);
  if (!finder) return fail(ExitCode::device, finder.error());
  const auto evaluation = eval_face(options.folder, options.out, **finder);
  if (!evaluation) return fail(ExitCode::device, evaluation.error());
  fmt::print("{} finder: {} pictures, {} with a remote face\n", (*finder)->name(), evaluation->pictures,
             evaluation->picked);
  if (evaluation->scores) fmt::print("{}", report(*evaluation->scores));
  return ExitCode::ok;
}

}  // namespace

void add_eval(CLI::App& app, ExitCode& result) {
  CLI::App* eval = app.add_subcommand("eval", "Measure an algorithm on recorded pictures");
  eval->require_subcommand(1);

  auto touch = std::make_shared<TouchOptions>();
  auto rig = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>();
  CLI::App* eval_touch = eval->add_subcommand("touch", "Fingers of a recording: a row a touch, and the error table");
  eval_touch->add_option("rig", *rig, "The recording's folder")->required()->type_name("RIG_DIR");
  eval_touch->add_option("--out", *out, "CSV: frame,contact,x_mm,y_mm")->required()->type_name("FILE.csv");
  eval_touch->add_option("--part", touch->eval.part, "Which pictures")
      ->check(CLI::IsMember({"frames", "hard", "sequence"}))
      ->capture_default_str();
  add_algorithm_options(*eval_touch, touch->eval.algorithm, touch->beside_thesis);
  eval_touch->add_option("--calibration", touch->eval.calibration, "Numbers of the calibration pictures to use: 1,2")
      ->delimiter(',');
  eval_touch->add_option("--report", touch->report, "A page with tables, plots and pictures of failures")
      ->type_name("FILE.html");
  eval_touch->callback([=, &result] {
    touch->eval.rig = *rig;
    touch->eval.out = *out;
    result = evaluate_touch(*touch);
  });

  add_eval_rigs(*eval, result);

  auto face = std::make_shared<FaceOptions>();
  CLI::App* eval_face = eval->add_subcommand("face", "Remote faces of a folder of screen pictures: a row a picture");
  eval_face->add_option("folder", face->folder, "Pictures, perhaps with labels.csv")->required()->type_name("DIR");
  eval_face->add_option("--out", face->out, "CSV: image,face_x,face_y,face_w,face_h")
      ->required()
      ->type_name("FILE.csv");
  add_face_option(*eval_face, face->finder);
  eval_face->callback([face, &result] { result = evaluate_face(*face); });
}

}  // namespace telehug
