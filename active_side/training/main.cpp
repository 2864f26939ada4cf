// SPDX-License-Identifier: Apache-2.0
//
// Renders random virtual rigs and writes what the nets of active_side/finger learn from. See README.md here.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "example_writer.hpp"
#include "pictures/picture_file.hpp"
#include "rendered_rig.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<cv::Mat> read_pictures(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".jpg" || entry.path().extension() == ".png") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<cv::Mat> pictures;
  for (const fs::path& path : paths) {
    auto picture = telehug::read_picture(path);
    if (!picture || picture->cols < 300 || picture->rows < 200) continue;
    const double scale = std::min(1.0, 1600.0 / picture->cols);
    cv::resize(*picture, *picture, {}, scale, scale, cv::INTER_AREA);
    pictures.push_back(*std::move(picture));
  }
  return pictures;
}

int write_examples(int argc, char** argv) {
  CLI::App app("Writes examples for the finger nets");
  std::uint64_t from = 1'000'000;
  int rigs = 10;
  int frames = 12;
  std::string out;
  std::string folder;
  app.add_option("--from", from, "Seed of the first rig");
  app.add_option("--rigs", rigs, "How many rigs");
  app.add_option("--frames", frames, "How many pictures of each");
  app.add_option("--pictures", folder, "What some of the screens show: JPEG and PNG files, in subfolders too")
      ->check(CLI::ExistingDirectory);
  app.add_option("out", out, "File to write")->required();
  CLI11_PARSE(app, argc, argv);
  cv::setNumThreads(1);

  const std::vector<cv::Mat> pictures = folder.empty() ? std::vector<cv::Mat>{} : read_pictures(folder);
  if (pictures.empty() && !folder.empty()) {
    fmt::print(stderr, "no picture of 300 x 200 pixels or more in {}\n", folder);
    return 1;
  }
  std::ofstream file(out, std::ios::binary);
  if (!file) {
    fmt::print(stderr, "can't write {}\n", out);
    return 1;
  }
  for (int i = 0; i < rigs; ++i) {
    const std::uint64_t seed = from + static_cast<std::uint64_t>(i);
    try {
      telehug::RenderedRig rig(seed, pictures);
      telehug::ExampleWriter writer(file, static_cast<std::uint32_t>(seed), rig.camera(), rig.screen(),
                                    rig.background());
      for (int k = 0; k < frames; ++k)
        writer.write(rig.frame(static_cast<std::uint64_t>(k)), seed * 1000 + static_cast<std::uint64_t>(k));
    } catch (const std::exception& problem) {
      fmt::print(stderr, "rig {}: {}\n", seed, problem.what());
    }
  }
  file.close();
  if (!file) fmt::print(stderr, "can't write {}\n", out);
  return file ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return write_examples(argc, argv);
  } catch (const std::exception& problem) {
    (void)std::fprintf(stderr, "telehug-training-frames: %s\n", problem.what());
    return 1;
  }
}
