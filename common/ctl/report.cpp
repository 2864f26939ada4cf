// SPDX-License-Identifier: Apache-2.0
//
// `telehug report`: one file for a bug report, which a person can read before sending it.
#include <fmt/chrono.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <memory>
#include <span>

#include "ctl/command.hpp"
#include "ctl/report/gather.hpp"
#include "files/private_file.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigChoice choice;
  std::string output;
};

Status write(const std::filesystem::path& path, const std::string& text) {
  auto file = PrivateFile::create(path);
  if (!file) return file.error();
  Status written = file->append(text);
  if (written) written = file->close();
  if (written) return Done{};
  // Else it would be in the way once there is room.
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return written;
}

ExitCode run(const Options& options) {
  const std::filesystem::path path =
      options.output.empty() ? fmt::format("telehug-report-{:%Y%m%d-%H%M%S}.txt", fmt::localtime(std::time(nullptr)))
                             : options.output;
  if (const Status written = write(path, make_report(options.choice)); !written) {
    fmt::print(stderr, "telehug: {}\n", written.error().message);
    return ExitCode::internal;
  }
  fmt::print("{}\n{}Read it before you send it.\n", std::filesystem::absolute(path).string(), report_contents());
  return ExitCode::ok;
}

}  // namespace

void add_report(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("report", "Write one file for a bug report: no pictures, names, addresses, keys or codes");
  add_config_choice(*command, options->choice);
  command
      ->add_option("--output", options->output,
                   "The file, which must not be there yet (default: telehug-report-DATE-TIME.txt here)")
      ->type_name("FILE");
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
