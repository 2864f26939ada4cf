// SPDX-License-Identifier: Apache-2.0
#include "common/version.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "ctl/command.hpp"

namespace telehug {

void add_version(CLI::App& app, ExitCode& result) {
  CLI::App* command = app.add_subcommand("version", "Print the version of this program");
  command->callback([&result] {
    fmt::print("telehug {}\n", version);
    result = ExitCode::ok;
  });
}

}  // namespace telehug
