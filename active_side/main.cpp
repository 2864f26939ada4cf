// SPDX-License-Identifier: Apache-2.0
#include <opencv2/core/utility.hpp>

#include "cli/program.hpp"
#include "commands/command.hpp"

namespace {

using telehug::ExitCode;

const telehug::Program program{
    .name = "telehug-active",
    .purpose = "Sees touches on this PC's monitor and sends them to the other side.",
    .examples =
        {
            {"telehug-active calibrate --width-mm 380 --height-mm 300",
             "with the webcam: asks for touches of known points"},
            {"telehug-active calibrate --source replay:RIG_DIR", "of a recording"},
            {"telehug-active camera tune", "in difficult light: chooses exposure and more"},
            {"telehug-active camera check", "is there light enough?"},
            {"telehug-active camera list", "what can be set and how it is"},
            {"telehug-active camera restore", "as it was before telehug changed it"},
            {"telehug-active run", "the daemon, as the configuration says"},
            {"telehug-active run --source webcam --set body_map.picture=chat.jpg", "on a still picture"},
            {"telehug-active look --seconds 10", "what is seen of the person on this screen"},
            {"telehug-active record DIR --seconds 20", "keeps what the camera sees"},
            {"telehug-active eval touch RIG_DIR --out touches.csv --detector thesis --model thesis",
             "the thesis' algorithm on a recording"},
            {"telehug-active eval face DIR --out faces.csv", "where the face is in each picture"},
            {"telehug-active eval rigs --from 1 --count 100 --report rigs.html", "on a hundred rigs drawn at random"},
            {"telehug-active show-boxes chat.jpg --out boxes.png", "the grid of boxes on a picture"},
        },
    .exits = {ExitCode::ok, ExitCode::internal, ExitCode::usage, ExitCode::config, ExitCode::device,
              ExitCode::already_running, ExitCode::network, ExitCode::pair_ended},
    .see_also = {"telehug(1)", "telehug-active.toml(5)", "telehug(7)", "telehug-daemons(8)"},
};

void add_commands(CLI::App& app, ExitCode& result) {
  telehug::add_run(app, result);
  telehug::add_calibrate(app, result);
  telehug::add_camera(app, result);
  telehug::add_record(app, result);
  telehug::add_eval(app, result);
  telehug::add_show_boxes(app, result);
  telehug::add_look(app, result);
}

}  // namespace

int main(int argc, char** argv) {
  // A second thread makes nothing here faster and would compete with the touch path.
  cv::setNumThreads(1);
  return telehug::run_program(argc, argv, program, add_commands);
}
