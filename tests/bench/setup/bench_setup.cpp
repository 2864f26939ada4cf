// SPDX-License-Identifier: Apache-2.0
//
// Whole set-ups of random rigs by a simulated person: do they end well, how long do they take, and how exact is what
// they find?
//   bench_setup [--from SEED] [--to SEED] [--two-dots] [--turned-deg DEG] [--trace] [--pictures FOLDER] [--json FILE]
// Ends with 1 if a calibration that is wrong would have been saved.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <thread>
#include <vector>

#include "doubles/random_set_up.hpp"

namespace telehug {
namespace {

struct Wanted {
  std::uint64_t from = 700;
  std::uint64_t to = 723;
  SetUpTrial trial;
  std::string json_file;
};

void print(const SetUpOutcome& outcome) {
  const std::string errors = outcome.errors ? fmt::format("{:8.2f} {:8.2f}", outcome.errors->x_mm, outcome.errors->y_mm)
                                            : fmt::format("{:>8} {:>8}", "-", "-");
  fmt::print("{:5}  {:<8} {:6.1f} {:5} {:5} {:5} {}  {}\n", outcome.seed, outcome.name(), outcome.seconds,
             outcome.dots_used, outcome.repeated, outcome.lifted, errors, outcome.said);
}

nlohmann::json as_json(const SetUpOutcome& outcome) {
  nlohmann::json json{{"outcome", outcome.name()},    {"seconds", outcome.seconds}, {"dots_used", outcome.dots_used},
                      {"repeated", outcome.repeated}, {"lifted", outcome.lifted},   {"said", outcome.said}};
  if (outcome.errors) json["mean_error_mm"] = {{"x", outcome.errors->x_mm}, {"y", outcome.errors->y_mm}};
  return json;
}

std::vector<SetUpOutcome> set_up_all(const Wanted& wanted) {
  std::vector<SetUpOutcome> outcomes(wanted.to - wanted.from + 1);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < outcomes.size(); i = next++)
      outcomes[i] = set_up_random_rig(wanted.from + i, wanted.trial);
  };
  constexpr std::size_t most_threads = 2;
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < std::min<std::size_t>(most_threads, std::thread::hardware_concurrency()); ++i)
    threads.emplace_back(work);
  work();
  for (std::thread& thread : threads)
    thread.join();
  return outcomes;
}

int run(const Wanted& wanted) {
  cv::setNumThreads(1);
  const std::vector<SetUpOutcome> outcomes = set_up_all(wanted);
  fmt::print("{:>5}  {:<8} {:>6} {:>5} {:>5} {:>5} {:>8} {:>8}  {}\n", "rig", "outcome", "s", "used", "again", "lifts",
             "x mm", "y mm", "where it stood, and what was said");
  nlohmann::json json;
  std::size_t good = 0, wrong = 0;
  for (const SetUpOutcome& outcome : outcomes) {
    print(outcome);
    json[std::to_string(outcome.seed)] = as_json(outcome);
    good += outcome.end == SetUpEnd::good ? 1 : 0;
    wrong += outcome.end == SetUpEnd::wrong ? 1 : 0;
  }
  fmt::print("{} of {} good, {} wrong\n", good, outcomes.size(), wrong);
  if (!wanted.json_file.empty()) std::ofstream(wanted.json_file) << json.dump(2) << '\n';
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) {
  telehug::Wanted wanted;
  CLI::App app{"Whole set-ups of random rigs by a simulated person"};
  app.add_option("--from", wanted.from, "the first rig's seed")->capture_default_str();
  app.add_option("--to", wanted.to, "the last rig's seed")->capture_default_str();
  app.add_flag("--two-dots", wanted.trial.quick, "instead of nine");
  app.add_option("--turned-deg", wanted.trial.turned_deg, "turn cameras towards the user (< 0: the screen) before");
  app.add_flag("--trace", wanted.trial.trace, "print what each session says, as it says it");
  app.add_option("--pictures", wanted.trial.pictures, "folder for the last picture of each rig that is not good");
  app.add_option("--json", wanted.json_file, "write the outcomes down, too");
  CLI11_PARSE(app, argc, argv);
  try {
    if (wanted.to < wanted.from) throw std::invalid_argument("--to is before --from");
    return telehug::run(wanted);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "bench_setup: {}\n", problem.what());
    return 2;
  }
}
