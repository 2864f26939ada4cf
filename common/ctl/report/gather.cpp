// SPDX-License-Identifier: Apache-2.0
#include "ctl/report/gather.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <pwd.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <sstream>

#include "common/version.hpp"
#include "config/places.hpp"
#include "ctl/doctor/doctor_text.hpp"
#include "ctl/doctor/gather.hpp"
#include "ctl/plain_text.hpp"
#include "ctl/report/report.hpp"
#include "ctl/run_program.hpp"
#include "files/text_file.hpp"
#include "pairing/pairing.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr const char* journal_lines = "200";

std::string heading(const std::string& title) {
  return fmt::format("\n== {} ==\n", title);
}

// Lines without what moves a terminal's cursor.
std::string plain_lines(const std::string& text) {
  std::string plain;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    plain += plain_text(line) + "\n";
  return plain;
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

void hide_user(const passwd* user, Masker& masker) {
  if (user == nullptr) return;
  masker.hide(user->pw_name, "user");
  masker.hide(user->pw_dir, "home");
  const std::string full_name = user->pw_gecos == nullptr ? "" : user->pw_gecos;
  masker.hide(full_name.substr(0, full_name.find(',')), "user");
}

void hide_this_pc(Masker& masker) {
  utsname names{};
  if (::uname(&names) == 0) masker.hide(names.nodename, "this PC");
  masker.hide(variable("HOME"), "home");
  hide_user(::getpwuid(::geteuid()), masker);
  for (const char* name : {"USER", "SUDO_USER"}) {
    masker.hide(variable(name), "user");
    hide_user(::getpwnam(variable(name).c_str()), masker);
  }
}

// Also of pairs that are over: whoever the journal has lines about.
void hide_peers_of_journal(Masker& masker) {
  const auto run =
      run_program({"journalctl", "--field=TELEHUG_PEER", "--no-pager", "-q"}, 10s, "there is no journalctl");
  if (!run || run->code != 0) return;  // nor does this report tell of it, then
  std::istringstream names(run->output);
  for (std::string name; std::getline(names, name);)
    if (name != "the other side") masker.hide(name, "name");  // as a peer without a pair is called
}

void hide_pairs(const PeerConfig& peer, Side side, Masker& masker) {
  try {
    for (const Pair& pair : PairStore(pairs_folder(peer, side), side).list()) {
      masker.hide(pair.name, "name");
      masker.hide(pair.phrase, "phrase");
      masker.hide(pair.id, "id");
    }
  } catch (const std::runtime_error&) {
    // They can't be read by this user, so that neither this report tells of them.
  }
}

std::string versions() {
  utsname names{};
  ::uname(&names);
  std::string text = fmt::format("telehug {}\nkernel {} {} {}\n", version, names.release, names.version, names.machine);
  std::istringstream release(content_of("/etc/os-release"));
  for (std::string line; std::getline(release, line);)
    if (line.starts_with("PRETTY_NAME=")) text += plain_text(line.substr(line.find('=') + 1)) + "\n";
  for (const char* name : {"XDG_SESSION_TYPE", "XDG_CURRENT_DESKTOP", "LANG"})
    if (const std::string value = variable(name); !value.empty())
      text += fmt::format("{} {}\n", name, plain_text(value));
  const auto run = run_program({"dpkg-query", "-W", "-f", "${db:Status-Abbrev}${Package} ${Version}\n", "telehug*",
                                "libfastrtps*", "libopencv-core*", "libssl3*", "libjpeg62-turbo", "libgpiod2",
                                "libpipewire-0.3-0*", "pipewire", "xdg-desktop-portal*", "bluez", "systemd", "avrdude"},
                               10s, "there is no dpkg");
  if (!run) return text + "libraries: not known, " + run.error().message + "\n";
  std::istringstream lines(run->output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("ii ")) text += plain_text(line.substr(3)) + "\n";
  return text;
}

std::string journal_of(Side side, bool user) {
  const std::string unit = user ? "telehug-active" : system_unit(side);
  const std::string name = fmt::format("{} {}", user ? "--user-unit" : "-u", unit);
  const auto run = run_program({"journalctl", user ? "--user-unit=" + unit : "--unit=" + unit, "-n", journal_lines,
                                "--no-pager", "--no-hostname", "-q", "-o", "short-iso"},
                               10s, "there is no journalctl");
  if (!run) return fmt::format("{}: {}\n", name, run.error().message);
  if (run->code != 0) return fmt::format("{}: no journal can be read\n", name);
  return fmt::format("{}: {}\n", name,
                     run->output.empty() ? "nothing is in the journal" : "\n" + plain_lines(run->output));
}

const Json* status_of(const DoctorFacts& facts, Side side) {
  for (const Json& status : facts.daemons)
    if (status.value("side", "") == side_name(side)) return &status;
  return nullptr;
}

std::string read_or_nothing(const fs::path& file) {
  const auto text = read_text_file(file);
  return text ? *text : "";
}

std::string jacket_of(const ConfigSources& sources, const DoctorFacts& facts) {
  const fs::path file = jacket_profile_file(readable_passive_config(sources).jacket);
  const bool installed = file.parent_path() == jacket_profile_file({}).parent_path();
  const Json* status = status_of(facts, Side::passive);
  return jacket_section(read_or_nothing(file), installed, status == nullptr ? Json() : *status);
}

PeerConfig peer_of(const ConfigSources& sources, Side side) {
  return side == Side::active ? readable_active_config(sources).peer : readable_passive_config(sources).peer;
}

}  // namespace

std::string report_contents() {
  return "In it: versions, what telehug doctor finds, what of the configuration is not as shipped, the daemons' "
         "status,\n"
         "figures of the calibration, jacket profile and firmware, the last lines of the log.\n"
         "Not in it: pictures, keys, pairing codes, names of people and PCs, addresses, window titles, reasons, what "
         "was\n"
         "touched and when the wearer wants to be left alone. In their place stand words in [brackets].\n";
}

std::string make_report(const ConfigChoice& choice) {
  DoctorWishes wishes;
  if (!choice.side.empty()) wishes.sides = choice.sides();
  wishes.sources = choice.sources();
  wishes.system = choice.system;
  const DoctorFacts facts = gather_facts(wishes);
  wishes.sources = choice.sources();  // under sudo that may be another person's by now

  Masker masker;
  hide_this_pc(masker);
  hide_peers_of_journal(masker);
  for (const Side side : {Side::active, Side::passive}) {
    hide_texts_of(inspect_config(wishes.sources, side), masker);
    hide_pairs(peer_of(wishes.sources, side), side, masker);
    const StateOfService state(true);
    hide_pairs(peer_of(wishes.sources, side), side, masker);
  }
  for (const Json& status : facts.daemons)
    hide_texts_of(status, masker);

  std::string text = fmt::format("telehug report, {:%Y-%m-%d %H:%M} UTC\n", fmt::gmtime(std::time(nullptr)));
  text += report_contents();
  text += heading("versions") + masker.mask(versions());
  text += heading("doctor") + masker.mask_free_text(doctor_text(all_checks(facts)));
  text += heading("configuration");
  for (const SideFacts& side : facts.sides)
    text += config_section(inspect_config(sources_of(side.account, wishes.sources), side.side), side.side, masker);
  text += heading("status");
  for (const SideFacts& side : facts.sides) {
    const Json* status = status_of(facts, side.side);
    text += status == nullptr ? fmt::format("telehug-{} does not run\n", side_name(side.side))
                              : status_section(*status, masker);
  }
  if (find_side(facts, Side::active) != nullptr)
    text += heading("calibration") + masker.mask(calibration_section(read_or_nothing(facts.calibration.file)));
  if (find_side(facts, Side::passive) != nullptr)
    text += heading("jacket") + masker.mask(jacket_of(wishes.sources, facts));
  text += heading("log");
  for (const SideFacts& side : facts.sides) {
    if (side.side == Side::active) text += masker.mask_free_text(journal_of(side.side, true));
    text += masker.mask_free_text(journal_of(side.side, false));
  }
  return text;
}

}  // namespace telehug
