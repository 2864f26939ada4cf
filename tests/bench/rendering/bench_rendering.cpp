// SPDX-License-Identifier: Apache-2.0
//
// How exactly touches are felt where they are: for each jacket a table, and a picture if wanted.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/rendering/accuracy.hpp"
#include "bench/rendering/accuracy_picture.hpp"
#include "jacket/load_jacket_profile.hpp"

namespace telehug {
namespace {

// All that are shipped and whose firmware knows strengths.
std::vector<std::string> shipped_profiles() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(TELEHUG_SOURCE "/deploy/jackets")) {
    if (entry.path().extension() != ".toml") continue;
    const auto profile = load_jacket_profile(entry.path());
    if (!profile || profile->protocol == JacketProtocol::telehug) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error(path.string() + ": can't be written");
}

std::string caption(const std::vector<FeltPlace>& places) {
  const AccuracySummary between = summarise(places, true);
  const AccuracySummary all = summarise(places, false);
  return fmt::format("mean error between motors {:.3f} fh (at most {:.3f}), everywhere {:.3f} (at most {:.3f})",
                     between.mean_fh, between.most_fh, all.mean_fh, all.most_fh);
}

void measure(const std::string& file, const std::string& picture_folder, nlohmann::json& figures) {
  auto profile = load_jacket_profile(file);
  if (!profile) throw std::runtime_error(profile.error().message);
  const std::string name = std::filesystem::path(file).stem();
  for (const Rendering rendering : {Rendering::places, Rendering::boxes}) {
    profile->rendering = rendering;
    const char* by = rendering == Rendering::places ? "places" : "boxes";
    for (const Seen seen : {Seen::drives, Seen::steps}) {
      const auto places = measure_accuracy(*profile, seen);
      for (const bool between : {true, false}) {
        const AccuracySummary sum = summarise(places, between);
        const std::string figure = fmt::format("rendering.{}.{}{}{}", name, by, between ? ".between_motors" : "",
                                               seen == Seen::steps ? ".in_steps" : "");
        fmt::print("{:<62}{:>8.3f}{:>8.3f}{:>8.3f}{:>9}{:>10}\n", figure, sum.mean_fh, sum.p99_fh, sum.most_fh,
                   sum.touches, sum.uncovered);
        figures[figure] = {
            {"p50", sum.median_fh}, {"p99", sum.p99_fh}, {"mean", sum.mean_fh}, {"max", sum.most_fh}, {"unit", "fh"}};
      }
      if (picture_folder.empty() || seen == Seen::drives) continue;
      write(std::filesystem::path(picture_folder) / fmt::format("{}-{}.svg", name, by),
            accuracy_picture(*profile, places, fmt::format("{}, by {}", profile->name, by), caption(places)));
    }
  }
}

int run(int argc, char** argv) {
  CLI::App app{"How exactly touches are felt where they are: the error of each jacket in face heights"};
  std::string json_file;
  std::string pictures;
  std::vector<std::string> profiles;
  app.add_option("profiles", profiles, "Jackets to measure; without any those in deploy/jackets");
  app.add_option("--json", json_file, "Write the figures to this file");
  app.add_option("--svg", pictures, "Draw each jacket into this folder, as NAME-places.svg and NAME-boxes.svg");
  CLI11_PARSE(app, argc, argv);
  if (profiles.empty()) profiles = shipped_profiles();

  nlohmann::json figures;
  fmt::print("{:<62}{:>8}{:>8}{:>8}{:>9}{:>10}\n", "error in face heights", "mean", "p99", "max", "touches",
             "uncovered");
  for (const std::string& profile : profiles)
    measure(profile, pictures, figures);
  if (!json_file.empty()) write(json_file, figures.dump(2) + '\n');
  return 0;
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) {
  try {
    return telehug::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_rendering: {}\n", error.what());
    return 1;
  }
}
