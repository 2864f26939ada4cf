// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `telehug`, one a file. Each adds itself to the command line and, when it is the one that was
// asked for, leaves how it ended in `result`.
#pragma once

#include "service/exit_code.hpp"

namespace CLI {
class App;
}

namespace telehug {

void add_status(CLI::App& app, ExitCode& result);
void add_watch(CLI::App& app, ExitCode& result);
void add_stop(CLI::App& app, ExitCode& result);
void add_resume(CLI::App& app, ExitCode& result);
void add_pause(CLI::App& app, ExitCode& result);
void add_unpause(CLI::App& app, ExitCode& result);
void add_metrics(CLI::App& app, ExitCode& result);
void add_mute(CLI::App& app, ExitCode& result);
void add_unmute(CLI::App& app, ExitCode& result);
void add_strength(CLI::App& app, ExitCode& result);
void add_quiet(CLI::App& app, ExitCode& result);
void add_send(CLI::App& app, ExitCode& result);
void add_face(CLI::App& app, ExitCode& result);
void add_hug(CLI::App& app, ExitCode& result);
void add_jacket(CLI::App& app, ExitCode& result);
void add_open(CLI::App& app, ExitCode& result);
void add_config(CLI::App& app, ExitCode& result);
void add_doctor(CLI::App& app, ExitCode& result);
void add_report(CLI::App& app, ExitCode& result);
void add_pair(CLI::App& app, ExitCode& result);
void add_version(CLI::App& app, ExitCode& result);

}  // namespace telehug
