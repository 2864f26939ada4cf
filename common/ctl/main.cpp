// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"
#include "ctl/command.hpp"

namespace {

using telehug::ExitCode;

const telehug::Program program{
    .name = "telehug",
    .purpose = "Looks after the telehug daemons on this PC, through their local sockets, and pairs it with another PC.",
    .examples =
        {
            {"telehug status", "how the daemons on this PC are"},
            {"telehug status --json | jq .", "the same for programs"},
            {"telehug status --check --side active && echo ready",
             "for scripts: what is not as it should be, as exit code"},
            {"telehug watch", "touches and answers as they happen"},
            {"telehug watch --json --count 1", "waits for the next event"},
            {"telehug metrics --side passive", "counters and latencies for a scraper (OpenMetrics)"},
            {"telehug open", "this side's pages in the browser"},
            {"telehug open --start", "what the desktop's entry does: also starts the parent's side"},
            {"telehug open passive --print", "only the link"},
            {"telehug stop --reason \"dinner\"", "everything off, on both PCs"},
            {"telehug resume", "ends this PC's own stop"},
            {"telehug pause 30", "the wearer wants nothing felt for half an hour"},
            {"telehug pause", "until `telehug unpause`"},
            {"telehug unpause", "ends the pause"},
            {"telehug mute 8 13", "nor ever in these boxes"},
            {"telehug mute --actuator 3", "nor by this motor"},
            {"telehug unmute 8", "in this box again"},
            {"telehug unmute --all", "everywhere again"},
            {"telehug strength 50", "all is felt half as strongly as the limits allow"},
            {"telehug quiet 20:30-07:00", "and nothing at all at night"},
            {"telehug quiet none", "at night, too"},
            {"telehug send off", "touches on this screen touch nobody"},
            {"telehug send auto", "as it was"},
            {"telehug face next", "the other person in the picture is meant"},
            {"telehug hug --seconds 4", "felt by the wearer; from the wearer's PC seen and heard by the sender"},
            {"telehug jacket identify", "on the wearer's PC: runs the motors one by one, telling their names"},
            {"telehug jacket list --out jacket.svg", "what it has; also as a picture"},
            {"telehug jacket test 5 --strength 0.5", "runs one motor"},
            {"telehug jacket flash", "writes the firmware through the port of the configuration"},
            {"telehug jacket flash --programmer usbasp --set-fuses", "without a bootloader"},
            {"telehug pair invite --name \"Mum\"", "makes a pair of this PC and another one; prints a code"},
            {"telehug pair invite --qr", "and shows it to a camera"},
            {"telehug pair accept CODE --name \"Kim\"", "on the other PC"},
            {"telehug pair list", "who may touch, or be touched"},
            {"telehug pair revoke 0123456789abcdef", "ends a pair, at once"},
            {"telehug pair request --file request.txt", "where the PCs can't reach each other"},
            {"telehug pair grant --file request.txt > grant.txt", "on the wearer's PC"},
            {"telehug pair finish --file grant.txt", "on the parent's PC"},
            {"telehug pair renew Mum --file renewal.txt", "another year, by hand"},
            {"telehug config check", "all faults of the configuration, each with file and line"},
            {"telehug config check passive --system", "as the system's service reads it"},
            {"telehug config show active", "every key, its value and where that comes from"},
            {"telehug config diff", "only what is not as shipped"},
            {"telehug doctor", "what keeps telehug from working here, and what mends it"},
            {"telehug doctor passive --json", "the wearer's side alone, for programs"},
            {"telehug doctor passive --bootloader", "also the jacket's bootloader, which resets the jacket"},
            {"telehug report --output report.txt", "one file for a bug report, to read before it is sent"},
            {"telehug version", "of this program"},
        },
    .exits = {ExitCode::ok, ExitCode::internal, ExitCode::usage, ExitCode::config, ExitCode::device,
              ExitCode::not_running, ExitCode::peer_absent, ExitCode::permission, ExitCode::bad_answer,
              ExitCode::refused, ExitCode::stopped, ExitCode::fault, ExitCode::network},
    .see_also = {"telehug-active(1)", "telehug-passive(1)", "telehug-active.toml(5)", "telehug-passive.toml(5)",
                 "telehug(7)", "telehug-daemons(8)"},
};

void add_commands(CLI::App& app, ExitCode& result) {
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
  telehug::add_config(app, result);
  telehug::add_doctor(app, result);
  telehug::add_report(app, result);
  telehug::add_version(app, result);
}

}  // namespace

int main(int argc, char** argv) {
  return telehug::run_program(argc, argv, program, add_commands);
}
