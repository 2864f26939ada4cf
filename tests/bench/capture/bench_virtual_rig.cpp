// SPDX-License-Identifier: Apache-2.0
//
// How long the virtual rig takes for a picture at 1280x720:
//   bench_rig [--json FILE]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "capture/virtual_rig/random_frame.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"
#include "capture/virtual_rig/touch_script.hpp"
#include "common/clock.hpp"

namespace telehug {
namespace {

constexpr int rounds = 200;

struct Figure {
  std::string name;
  std::vector<double> ms;

  [[nodiscard]] double percentile(double part) const {
    std::vector<double> sorted = ms;
    std::sort(sorted.begin(), sorted.end());
    return sorted.at(static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1)));
  }
};

template <typename Step>
Figure measured(std::string name, int times, Step&& step) {
  Figure figure{std::move(name), {}};
  for (int i = 0; i < times; ++i) {
    const Timestamp start = std::chrono::steady_clock::now();
    step(i);
    figure.ms.push_back(to_ms(std::chrono::steady_clock::now() - start));
  }
  return figure;
}

// The usual rig's script, while a finger is there, and at 60 Hz.
Figure measure_gesture() {
  const VirtualRigSettings settings;
  RigRenderer renderer(settings);
  const TouchScript script = default_script(settings.screen);
  std::vector<std::vector<HandPose>> frames;
  for (double time_s = 0; time_s < script.length_s; time_s += 1.0 / 60) {
    std::vector<HandPose> hands = hands_at(script, time_s);
    if (!hands.empty()) frames.push_back(std::move(hands));
  }
  cv::Mat bgr;
  return measured("rig.gesture_frame", static_cast<int>(frames.size()), [&](int i) {
    renderer.draw(frames[static_cast<std::size_t>(i)], static_cast<std::uint64_t>(i), bgr);
  });
}

// Single pictures of random rigs, each with a hand in a pose that was not there before.
Figure measure_random_pictures() {
  constexpr int rigs = 6;
  constexpr int pictures = 25;
  Figure figure{"rig.random_picture", {}};
  cv::Mat bgr;
  for (std::uint64_t seed = 0; seed < rigs; ++seed) {
    const RandomRig rig = random_rig(seed);
    RigRenderer renderer(rig.settings);
    const Figure of_rig = measured("", pictures, [&](int i) {
      const auto index = static_cast<std::uint64_t>(i);
      const FrameKind kind = i % 4 == 3 ? FrameKind::hover : FrameKind::touch;
      renderer.draw(random_frame(rig, kind, index).hands, index, bgr);
    });
    figure.ms.insert(figure.ms.end(), of_rig.ms.begin(), of_rig.ms.end());
  }
  return figure;
}

std::vector<Figure> measure() {
  VirtualRigSettings settings;
  RigRenderer renderer(settings);
  cv::Mat bgr;
  const auto stroke = [&](int i, bool two) {
    std::vector<HandPose> hands(1);
    hands[0].finger = {{150 + 0.4 * i, 180 + 0.3 * i}, 0};
    if (two) {
      HandPose left = hands[0];
      left.looks.emplace().left = true;
      left.finger.foot.x_mm -= 100;
      hands.push_back(left);
    }
    renderer.draw(hands, static_cast<std::uint64_t>(i), bgr);
  };
  std::vector<Figure> figures;
  figures.push_back(measured("rig.frame_nobody", rounds, [&](int i) {
    renderer.draw(std::vector<HandPose>{}, static_cast<std::uint64_t>(i), bgr);
  }));
  figures.push_back(measured("rig.frame_one_hand", rounds, [&](int i) { stroke(i, false); }));
  figures.push_back(measured("rig.frame_two_hands", rounds, [&](int i) { stroke(i, true); }));
  figures.push_back(measure_gesture());
  figures.push_back(measure_random_pictures());
  figures.push_back(measured("rig.new_pose", 20, [&](int i) {
    HandPose pose;
    pose.approach_deg = 40 + i;
    (void)hand_shape(pose, {});
  }));
  figures.push_back(measured("rig.new_scene", 10,
                             [&](int i) { (void)renderer.view(random_rig(static_cast<std::uint64_t>(i)).settings); }));
  figures.push_back(measured("rig.other_picture", 20, [&](int i) {
    VirtualRigSettings other = settings;
    other.seed = static_cast<std::uint64_t>(i);
    other.content = ScreenContent::chat;
    (void)renderer.view(other);
  }));
  VirtualRigSettings moving = settings;
  moving.content = ScreenContent::photo;
  moving.motion = ScreenMotion::scrolling;
  renderer.show(renderer.view(moving));
  figures.push_back(measured("rig.moving_screen", rounds, [&](int i) { renderer.move_screen(0.04 * i); }));
  return figures;
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  nlohmann::json json;
  fmt::print("{:<24}{:>10}{:>10}\n", "ms", "p50", "p99");
  for (const telehug::Figure& figure : telehug::measure()) {
    fmt::print("{:<24}{:>10.2f}{:>10.2f}\n", figure.name, figure.percentile(0.5), figure.percentile(0.99));
    json[figure.name] = {{"p50", figure.percentile(0.5)}, {"p99", figure.percentile(0.99)}, {"unit", "ms"}};
  }
  if (argc == 3 && std::string_view(argv[1]) == "--json") std::ofstream(argv[2]) << json.dump(2) << '\n';
  return 0;
}
