// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <opencv2/core/utility.hpp>

#include "commands/command.hpp"
#include "common/version.hpp"

namespace {

using telehug::ExitCode;

constexpr const char* examples = R"(
Examples:
  telehug-active calibrate --width-mm 380 --height-mm 300
  telehug-active camera tune
  telehug-active run --source webcam --set body_map.picture=chat.jpg
  telehug-active eval touch RIG_DIR --out touches.csv --detector thesis --model thesis
  telehug-active eval rigs --from 1 --count 100 --report rigs.html
  telehug-active show-boxes chat.jpg --out boxes.png

Exit codes: 0 ok, 1 fault of telehug, 2 wrong command line, 3 faults in the configuration, 4 a camera, picture or
  recording can't be used, 10 another telehug-active runs, 13 DDS can't be set up, 15 the pair was revoked or has
  expired.)";

ExitCode parse_and_run(int argc, char** argv) {
  // A second thread makes nothing here faster and would compete with the touch path.
  cv::setNumThreads(1);
  ExitCode result = ExitCode::ok;
  CLI::App app("Sees touches on this PC's monitor and sends them to the other side.", "telehug-active");
  app.footer(examples);
  app.set_version_flag("--version", telehug::version);
  app.require_subcommand(1);
  telehug::add_run(app, result);
  telehug::add_calibrate(app, result);
  telehug::add_camera(app, result);
  telehug::add_record(app, result);
  telehug::add_eval(app, result);
  telehug::add_show_boxes(app, result);
  telehug::add_look(app, result);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    // --help and --version come this way, too, with code 0.
    result = app.exit(problem) == 0 ? ExitCode::ok : ExitCode::usage;
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return telehug::to_int(parse_and_run(argc, argv));
  } catch (const std::exception& problem) {
    (void)std::fprintf(stderr, "telehug-active: %s\n", problem.what());
    return telehug::to_int(ExitCode::internal);
  }
}
