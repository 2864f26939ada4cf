// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `telehug-active`, one a file. Each adds itself to the command line and, when it is the one that
// was asked for, leaves how it ended in `result`.
#pragma once

#include <fmt/core.h>

#include <string>
#include <vector>

#include "common/result.hpp"
#include "service/exit_code.hpp"

namespace CLI {
class App;
}

namespace telehug {

void add_run(CLI::App& app, ExitCode& result);
void add_calibrate(CLI::App& app, ExitCode& result);
void add_record(CLI::App& app, ExitCode& result);
void add_camera(CLI::App& app, ExitCode& result);
void add_eval(CLI::App& app, ExitCode& result);
void add_show_boxes(CLI::App& app, ExitCode& result);
void add_look(CLI::App& app, ExitCode& result);

// The configuration's place on the command line, for subcommands that read it.
struct ConfigOptions {
  std::string file;
  std::vector<std::string> overrides;
};
void add_config_options(CLI::App& command, ConfigOptions& options);

// Says a failure on stderr.
inline ExitCode fail(ExitCode code, const Error& error) {
  fmt::print(stderr, "telehug-active: {}\n", error.message);
  return code;
}

}  // namespace telehug
