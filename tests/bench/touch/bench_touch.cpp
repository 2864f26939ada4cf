// SPDX-License-Identifier: Apache-2.0
//
// How long a frame takes on the touch path, stage by stage, and what it takes from the heap: the default algorithm at
// two sizes of the picture and with one finger and five, from decoded pictures and from MJPEG, beside the thesis'
// algorithm and the decoding of a whole frame.
//   bench_touch [--json FILE]
// p10 is the figure to compare variants by on a PC that does other things as well.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/touch/default_figures.hpp"
#include "bench/touch/figure.hpp"
#include "bench/touch/print_figures.hpp"
#include "bench/touch/thesis_figures.hpp"
#include "doubles/allocation_counter.hpp"
#include "pictures/jpeg_decoder.hpp"

namespace telehug {
namespace {

// The whole JPEG of a frame, as the webcam and the recording decode it before the touch path.
Figure measure_jpeg(const std::filesystem::path& picture) {
  constexpr int jpeg_rounds = 300;
  std::ifstream file(picture, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  JpegDecoder decoder;
  cv::Mat bgr;
  Figure figure{"camera.jpeg_1280x720", "ms"};
  for (int i = 0; i < jpeg_rounds; ++i) {
    Stopwatch watch;
    if (const Status decoded = decoder.decode(bytes, bgr); !decoded) throw std::runtime_error(decoded.error().message);
    figure.samples.push_back(watch.lap_ms());
  }
  return figure;
}

void run(const std::string& json_file) {
  cv::setNumThreads(1);
  Figures figures;
  const auto add = [&](Figures more) {
    for (Figure& figure : more)
      figures.push_back(std::move(figure));
  };
  add(measure_default({1280, 720}, 1, "_1280x720"));
  add(measure_default({1920, 1080}, 1, "_1920x1080"));
  add(measure_default({1280, 720}, 5, "_1280x720.five_fingers"));
  add(measure_default({1920, 1080}, 5, "_1920x1080.five_fingers"));
  add(measure_thesis(TELEHUG_FIXTURES "/rig2"));
  add({measure_jpeg(TELEHUG_FIXTURES "/rig2/background.jpg")});
  if (!allocations_are_counted()) {
    std::erase_if(figures, [](const Figure& figure) { return figure.unit == "allocations"; });
    fmt::print("allocations are not counted: the sanitizer has its own heap\n");
  }
  print_and_write(figures, json_file);
}

}  // namespace
}  // namespace telehug

int main(int count, char** arguments) {
  try {
    std::string json_file;
    if (count == 3 && std::string_view(arguments[1]) == "--json") {
      json_file = arguments[2];
    } else if (count != 1) {
      throw std::runtime_error("usage: bench_touch [--json FILE]");
    }
    telehug::run(json_file);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fputs((std::string(error.what()) + '\n').c_str(), stderr);
    return EXIT_FAILURE;
  }
}
