// SPDX-License-Identifier: Apache-2.0
#include "commands/eval_rigs.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "commands/utc_now.hpp"
#include "eval/rigs_csv.hpp"
#include "eval/rigs_eval.hpp"
#include "eval/rigs_table.hpp"
#include "eval_report/html_report.hpp"
#include "eval_report/make_report.hpp"

namespace telehug {
namespace {

struct Options {
  EvalRigsOptions eval;
  EvalAlgorithm algorithm;
  bool beside_thesis = false;
  std::string out;
  std::string report;
};

// On stderr: times differ from run to run, tables do not.
void tell_times(const std::vector<RigOutcome>& outcomes, double elapsed_s) {
  std::chrono::duration<double> drawing{};
  std::chrono::duration<double> evaluating{};
  for (const RigOutcome& rig : outcomes) {
    drawing += rig.drawing;
    evaluating += rig.evaluating;
  }
  const auto count = static_cast<double>(outcomes.size());
  fmt::print(stderr, "telehug-active: {} rigs in {:.0f} s; a rig took {:.2f} s to draw and {:.2f} s to evaluate\n",
             outcomes.size(), elapsed_s, drawing.count() / count, evaluating.count() / count);
}

ExitCode evaluate(Options options) {
  options.eval.rig.algorithms = {options.algorithm};
  if (options.beside_thesis) options.eval.rig.algorithms.push_back(thesis_algorithm);
  options.eval.rig.failure_pictures = !options.report.empty();
  constexpr std::size_t between_words = 100;
  const auto begin = std::chrono::steady_clock::now();
  const RigsResult result = eval_rigs(options.eval, [&](std::size_t done) {
    if (done % between_words == 0) {
      fmt::print(stderr, "telehug-active: {} of {} rigs\n", done, options.eval.count);
    }
  });
  tell_times(result.rigs, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  for (std::size_t i = 0; i < options.eval.rig.algorithms.size(); ++i)
    fmt::print("{}{}", i > 0 ? "\n" : "", format_rigs_table(options.eval, result.rigs, i));
  // A long run is not lost because one of its files can't be written.
  ExitCode ended = ExitCode::ok;
  const auto note = [&](const Status& written) {
    if (!written) ended = fail(ExitCode::device, written.error());
  };
  if (!options.out.empty()) note(write_rigs_csv(options.out, options.eval, result.rigs));
  if (!options.report.empty()) note(write_html_report(options.report, report_of(options.eval, result, utc_now())));
  return ended;
}

}  // namespace

void add_algorithm_options(CLI::App& command, EvalAlgorithm& algorithm, bool& beside_thesis) {
  command.add_option("--detector", algorithm.detector, "Which algorithm finds the finger")
      ->check(CLI::IsMember({"thesis", "default"}))
      ->capture_default_str();
  command.add_option("--model", algorithm.model, "Which model places it on the screen")
      ->check(CLI::IsMember({"thesis", "default"}))
      ->capture_default_str();
  command.add_flag("--beside-thesis", beside_thesis, "Also what the thesis' algorithm makes of the same pictures");
}

void add_eval_rigs(CLI::App& eval, ExitCode& result) {
  auto options = std::make_shared<Options>();
  options->eval.jobs = std::max(1U, std::thread::hardware_concurrency());
  CLI::App* rigs = eval.add_subcommand("rigs", "Many virtual rigs drawn at random: the error table by groups");
  rigs->add_option("--from", options->eval.first_seed, "Seed of the first rig; the next ones follow")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000}))
      ->capture_default_str();
  rigs->add_option("--count", options->eval.count, "How many rigs")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  rigs->add_option("--frames", options->eval.rig.frames, "Pictures a rig: touches, hovering and distant hands, nobody")
      ->check(CLI::Range(0, 10'000))
      ->capture_default_str();
  rigs->add_option("--hard", options->eval.rig.hard, "Pictures with two fingers or two hands a rig")
      ->check(CLI::Range(0, 10'000))
      ->capture_default_str();
  rigs->add_option("--dots", options->eval.rig.dots,
                   "How many touched dots calibrate a rig, beside border and triangle")
      ->check(CLI::IsMember({2, 9}))
      ->capture_default_str();
  add_algorithm_options(*rigs, options->algorithm, options->beside_thesis);
  rigs->add_option("--out", options->out, "CSV: a row a touch, false touch and frame without one")
      ->type_name("FILE.csv");
  rigs->add_option("--report", options->report, "A page with tables, plots and pictures of failures")
      ->type_name("FILE.html");
  rigs->add_option("--jobs", options->eval.jobs, "How many rigs at a time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  rigs->callback([options, &result] { result = evaluate(*options); });
}

}  // namespace telehug
