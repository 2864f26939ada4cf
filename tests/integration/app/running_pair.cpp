// SPDX-License-Identifier: Apache-2.0
#include "integration/app/running_pair.hpp"

#include <signal.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "daemon/membership.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr Duration longest_run = 60s;

std::string program(const std::string& name) {
  return TELEHUG_BIN "/" + name;
}

std::string fixture(const std::string& name) {
  return TELEHUG_FIXTURES "/" + name;
}

}  // namespace

bool eventually(const std::function<bool()>& condition, Duration longest) {
  const auto deadline = std::chrono::steady_clock::now() + longest;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(10ms);
  }
  return true;
}

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

RunningPair::RunningPair()
    : camera("replay:" + (folder / "held").string()),
      picture(fixture("chat/01_full.jpg")),
      calibration(folder / "rig.toml"),
      jacket_link("serial:" + (folder / "jacket").string()) {
  std::filesystem::create_directory(folder / "held");
  std::filesystem::create_symlink(fixture("rig2/sequence/012.jpg"), folder / "held" / "1.jpg");
  write_tireless_jacket();
}

// The shipped jacket, but that a finger may rest on it for longer than a motor's budget lasts, and that just the motors
// of its box are felt as long as it does.
void RunningPair::write_tireless_jacket() const {
  std::string profile = content_of(TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml");
  const auto replace = [&profile](const std::string& what, const std::string& by) {
    const auto at = profile.find(what);
    if (at == std::string::npos) throw std::runtime_error("the shipped jacket has no " + what);
    profile.replace(at, what.size(), by);
  };
  replace("max_duty = 0.6\n", "");
  replace("rendering = \"places\"", "rendering = \"boxes\"");
  folder.write("tireless.toml", profile);
}

RunningPair::~RunningPair() {
  for (const auto* child : {&active, &passive, &jacket}) {
    if (*child && (*child)->runs()) kill((*child)->pid(), SIGCONT);  // a stopped one would not end
  }
  active.reset();
  passive.reset();
  jacket.reset();
}

void RunningPair::calibrate(const std::string& source) const {
  const Outcome outcome = run({program("telehug-active"), "calibrate", "--config", "/dev/null", "--source", source,
                               "--out", calibration.string()});
  if (outcome.code != 0) throw std::runtime_error("the calibration failed: " + outcome.text);
}

PairStore RunningPair::pairs(Side side) const {
  return {folder / ("pairs-" + side_name(side)), side};
}

void RunningPair::pair_up(const std::string& wearer_at, WallTime when) const {
  PairStore parent = pairs(Side::active);
  const auto request = parent.request("Grandma");
  if (!request) throw std::runtime_error(request.error().message);
  const auto granted = pairs(Side::passive).grant(*request, "Mia", when, wearer_at);
  if (!granted) throw std::runtime_error(granted.error().message);
  if (const auto accepted = parent.accept(granted->grant, when); !accepted)
    throw std::runtime_error(accepted.error().message);
}

std::filesystem::path RunningPair::socket(Side side) const {
  return folder / (side_name(side) + ".sock");
}

std::filesystem::path RunningPair::stop_file(Side side) const {
  return folder / ("stop-" + side_name(side) + ".json");
}

std::vector<std::string> RunningPair::command(Side side, std::vector<std::string> settings) const {
  std::vector<std::string> words = side == Side::active ? active_prefix : passive_prefix;
  const auto& config = side == Side::active ? active_config : passive_config;
  words.insert(words.end(), {program("telehug-" + side_name(side)), "run", "--config", config.string()});
  settings.insert(settings.begin(), "control.stop_file=" + stop_file(side).string());
  settings.insert(settings.end(), {"peer.domain=" + std::to_string(domain_.id()),
                                   std::string("peer.loopback_only=") + (loopback_only ? "true" : "false"),
                                   "peer.pairs_folder=" + (folder / ("pairs-" + side_name(side))).string(),
                                   "peer.partition=" + domain_.partition(), "control.socket=" + socket(side).string()});
  for (const std::string& setting : settings)
    words.insert(words.end(), {"--set", setting});
  return words;
}

std::vector<std::string> RunningPair::passive_command() const {
  std::vector<std::string> settings{"jacket.link=" + jacket_link, "consent.file=" + (folder / "consent.json").string(),
                                    "jacket.profile=" + (folder / "tireless.toml").string()};
  settings.insert(settings.end(), passive_settings.begin(), passive_settings.end());
  return command(Side::passive, std::move(settings));
}

std::vector<std::string> RunningPair::active_command() const {
  std::vector<std::string> settings{"rig.calibration_file=" + calibration.string(),
                                    "body_map.picture=" + picture.string()};
  settings.insert(settings.end(), active_settings.begin(), active_settings.end());
  auto words = command(Side::active, std::move(settings));
  words.insert(words.end(), {"--source", camera, "--loop"});
  return words;
}

void RunningPair::start_jacket() {
  jacket.reset();
  std::vector<std::string> words{program("telehug-jacket-sim"), "--link",           folder / "jacket", "--pins",
                                 folder / "pins.csv",           "--die-with-parent"};
  words.insert(words.end(), jacket_options.begin(), jacket_options.end());
  jacket = std::make_unique<ChildProcess>(words, folder / "jacket.log");
}

void RunningPair::start_passive() {
  passive.reset();
  passive = std::make_unique<ChildProcess>(passive_command(), folder / "passive.log");
}

void RunningPair::start_active() {
  active.reset();
  active = std::make_unique<ChildProcess>(active_command(), folder / "active.log");
}

bool RunningPair::start_all() {
  start_jacket();
  start_passive();
  calibrate("replay:" + fixture("rig2"));
  start_active();
  return eventually([this] { return felt(); });
}

Outcome RunningPair::run(const std::vector<std::string>& command) const {
  const auto log = folder / "run.log";
  std::filesystem::remove(log);
  ChildProcess child(command, log);
  const bool ended = eventually([&] { return !child.runs(); }, longest_run);
  const auto code = child.end();
  return {ended ? code : std::nullopt, content_of(log)};
}

Outcome RunningPair::telehug(const std::string& command, Side side, const std::vector<std::string>& arguments) const {
  std::vector<std::string> words{program("telehug"), command, "--socket", socket(side)};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run(words);
}

Json RunningPair::status(Side side) const {
  auto client = ControlClient::connect(socket(side));
  if (!std::holds_alternative<ControlClient>(client)) return nullptr;
  auto answer = std::get<ControlClient>(client).ask({{"command", "status"}});
  return answer ? *std::move(answer) : Json(nullptr);
}

bool RunningPair::complains(Side side, const std::string& text) const {
  const Json answer = status(side);
  if (!answer.is_object()) return false;
  for (const Json& problem : answer.at("problems")) {
    const bool says_what_to_do = !problem.at("do").get<std::string>().empty();
    if (says_what_to_do && problem.at("what").get<std::string>().find(text) != std::string::npos) return true;
  }
  return false;
}

std::uint64_t RunningPair::counter(Side side, const std::string& name) const {
  const Json answer = status(side);
  return answer.is_object() ? answer.at("counters").at(name).get<std::uint64_t>() : 0;
}

bool RunningPair::camera_open() const {
  const Json answer = status(Side::active);
  return answer.is_object() && answer.at("camera").at("open").get<bool>();
}

std::string RunningPair::jacket_state() const {
  const Json answer = status(Side::passive);
  return answer.is_object() ? answer.at("jacket").at("state").get<std::string>() : "no answer";
}

std::vector<PinChange> RunningPair::pins() const {
  const auto log = folder / "pins.csv";
  return std::filesystem::exists(log) ? read_pins(log) : std::vector<PinChange>{};
}

std::set<int> RunningPair::running() const {
  std::set<int> channels;
  for (const PinChange& change : pins())
    change.on ? (void)channels.insert(change.channel) : (void)channels.erase(change.channel);
  return channels;
}

std::optional<double> RunningPair::ms_to_silence(const std::function<void()>& blow) const {
  if (!felt()) return std::nullopt;
  const std::int64_t before_ns = to_ns(SteadyClock{}.now());
  blow();
  if (!eventually([this] { return !felt(); }, 5s)) return std::nullopt;
  const std::int64_t silent_ns = pins().back().time_ns;
  if (silent_ns < before_ns) return std::nullopt;  // it had stopped by itself
  return static_cast<double>(silent_ns - before_ns) * 1e-6;
}

std::string RunningPair::logs() const {
  std::string all;
  for (const char* name : {"active.log", "passive.log", "jacket.log", "pins.csv"})
    all += std::string("\n--- ") + name + "\n" + content_of(folder / name);
  for (const Side side : {Side::active, Side::passive})
    all += "\n--- status " + side_name(side) + "\n" + status(side).dump(1);
  return all;
}

}  // namespace telehug
