// SPDX-License-Identifier: Apache-2.0
#include "body_map/show_boxes.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <vector>

#include "commands/command.hpp"
#include "commands/face_option.hpp"

namespace telehug {
namespace {

struct Options {
  std::string picture;
  std::string out;
  std::string finder = "blaze";
  std::uint16_t touched = 0;
  std::vector<double> at_px;
  std::vector<int> view_px;
};

ExitCode run(const Options& options) {
  const auto finder = chosen_face_finder(options.finder);
  if (!finder) return fail(ExitCode::device, finder.error());
  ShowBoxesOptions show;
  show.picture = options.picture;
  show.out = options.out;
  if (options.touched > 0) show.touched = options.touched;
  if (!options.at_px.empty()) show.touched_px = cv::Point2d(options.at_px[0], options.at_px[1]);
  if (!options.view_px.empty()) {
    show.view = cv::Rect(options.view_px[0], options.view_px[1], options.view_px[2], options.view_px[3]);
  }
  const auto shown = show_boxes(show, **finder);
  if (!shown) return fail(ExitCode::device, shown.error());
  fmt::print("face {:.0f},{:.0f} {:.0f}x{:.0f} px; {} x {} boxes; {}\n", shown->face.x, shown->face.y,
             shown->face.width, shown->face.height, shown->grid.columns, shown->grid.rows,
             shown->touched > 0 ? fmt::format("box {} touched", shown->touched) : "no box touched");
  return ExitCode::ok;
}

}  // namespace

void add_show_boxes(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("show-boxes", "Draw the face and the numbered boxes on a screen picture");
  command->add_option("picture", options->picture, "JPEG or PNG of the screen")->required()->type_name("PICTURE");
  command->add_option("--out", options->out, "The drawing")->required()->type_name("FILE.png");
  auto* touched = command->add_option("--touched", options->touched, "Highlight this box")->type_name("BOX");
  command->add_option("--at", options->at_px, "Highlight the box at this pixel: X,Y")
      ->delimiter(',')
      ->expected(2)
      ->excludes(touched);
  command->add_option("--view", options->view_px, "The chat's part of the picture, in pixels: X,Y,WIDTH,HEIGHT")
      ->delimiter(',')
      ->expected(4);
  add_face_option(*command, options->finder);
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
