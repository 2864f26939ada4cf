// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "ctl/command.hpp"

namespace {

using telehug::ExitCode;

constexpr const char* examples = R"(
Examples:
  telehug status                      how the daemons on this PC are
  telehug status --json | jq .        the same for programs
  telehug open                        this side's pages in the browser
  telehug status --check --side active && echo ready
  telehug watch                       touches and answers as they happen
  telehug metrics --side passive      counters and latencies for a scraper (OpenMetrics)
  telehug stop --reason "dinner"      everything off, on both PCs
  telehug resume
  telehug pause 30                    the wearer wants nothing felt for half an hour
  telehug mute 8 13                   nor ever in these boxes
  telehug strength 50                 and all else half as strongly as the limits allow
  telehug quiet 20:30-07:00           and nothing at all at night
  telehug send off                    touches on this screen touch nobody
  telehug face next                   the other person in the picture is meant
  telehug hug --seconds 4             felt by the wearer; from the wearer's PC seen and heard by the sender
  telehug jacket identify             on the wearer's PC: runs the motors one by one, telling their names
  telehug jacket flash                writes the firmware into the jacket
  telehug pair invite                 make a pair of this PC and another one

Exit codes: 0 ok, 1 fault of telehug, 2 wrong command line, 3 faulty configuration (jacket flash), 4 the jacket, its port,
  the programmer or avrdude can't be used (jacket flash), 5 no daemon is running, 6 peer absent (--check), 7 not allowed to
  use the socket, 8 the daemon does not answer properly, 9 the daemon refused, or you did when asked, 11 stopped or paused (--check),
  12 a side can't work (--check), 13 no network for `pair invite`.)";

ExitCode parse_and_run(int argc, char** argv) {
  ExitCode result = ExitCode::ok;
  CLI::App app("Looks after the telehug daemons on this PC, through their local sockets, and pairs it with another PC.",
               "telehug");
  app.footer(examples);
  app.require_subcommand(1);
  telehug::add_status(app, result);
  telehug::add_watch(app, result);
  telehug::add_metrics(app, result);
  telehug::add_stop(app, result);
  telehug::add_resume(app, result);
  telehug::add_pause(app, result);
  telehug::add_unpause(app, result);
  telehug::add_mute(app, result);
  telehug::add_unmute(app, result);
  telehug::add_strength(app, result);
  telehug::add_quiet(app, result);
  telehug::add_send(app, result);
  telehug::add_face(app, result);
  telehug::add_hug(app, result);
  telehug::add_jacket(app, result);
  telehug::add_open(app, result);
  telehug::add_pair(app, result);
  telehug::add_version(app, result);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    // --help comes this way, too, with code 0.
    result = app.exit(problem) == 0 ? ExitCode::ok : ExitCode::usage;
  }
  // Onto a full disk half of a grant may have been written: that is no success.
  if (std::fflush(stdout) != 0) throw std::runtime_error("the output can't be written: is the disk full?");
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return telehug::to_int(parse_and_run(argc, argv));
  } catch (const std::exception& problem) {
    (void)std::fprintf(stderr, "telehug: %s\n", problem.what());
    return telehug::to_int(ExitCode::internal);
  }
}
