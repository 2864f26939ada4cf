// SPDX-License-Identifier: Apache-2.0
#include <ctime>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "bench/body_map/face_figures.hpp"
#include "bench/body_map/moving_chat.hpp"
#include "bench/touch/drawn_touches.hpp"
#include "doubles/xvfb.hpp"
#include "face/make_face_finder.hpp"
#include "face_worker.hpp"
#include "screen_x11/x11_grabber.hpp"

namespace telehug {
namespace {

constexpr double rate_hz = 8;
const cv::Size screen_px(1920, 1080);
const BodyMapStepConfig step_config{
    .screen = ScreenSize{.width_mm = 480, .height_mm = 270, .width_px = screen_px.width, .height_px = screen_px.height},
    .rules = {},
    .tracker = {},
    .mirrored = false};

// Of this thread, so that what draws the chat does not count.
double thread_cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

std::unique_ptr<FaceFinder> blaze() {
  auto finder = make_blaze_face_finder();
  if (!finder) throw std::runtime_error(finder.error().message);
  return *std::move(finder);
}

}  // namespace

Figures measure_looking_at_a_screen() {
  const Xvfb server("1920x1080x24");
  MovingChat chat(server.display(), chat_on_screen(screen_px));
  const SteadyClock clock;
  X11Grabber grabber({.display = server.display()}, clock);
  if (const Status opened = grabber.open(); !opened) throw std::runtime_error(opened.error().message);
  const auto finder = blaze();
  BodyMapStep step(grabber, *finder, step_config);

  Figure look{"face.look_x11_1920x1080", "ms"};
  Figure core{"face.core_at_8hz_1920x1080", "% of a core"};
  Figure still{"face.core_at_8hz_1920x1080.still", "% of a core"};
  const auto look_for_a_second = [&](Figure* looks) {
    const double begun_ms = thread_cpu_ms();
    for (int i = 0; i < static_cast<int>(rate_hz); ++i) {
      Stopwatch watch;
      step.run();
      if (looks != nullptr) looks->samples.push_back(watch.lap_ms());
      std::this_thread::sleep_for(125ms);
    }
    return (thread_cpu_ms() - begun_ms) / (1e3 / rate_hz * rate_hz) * 100;
  };
  look_for_a_second(nullptr);
  for (int second = 0; second < 20; ++second)
    core.samples.push_back(look_for_a_second(&look));
  if (step.map().version == 0) throw std::runtime_error(step.problem());
  chat.stand_still(true);
  look_for_a_second(nullptr);
  for (int second = 0; second < 5; ++second)
    still.samples.push_back(look_for_a_second(nullptr));
  return {look, core, still};
}

Figures measure_touch_beside_face() {
  const Xvfb server("1920x1080x24");
  MovingChat chat(server.display(), chat_on_screen(screen_px));
  const SteadyClock clock;
  MetricsRegistry metrics;
  FaceWorker worker(std::make_unique<X11Grabber>(X11GrabberConfig{.display = server.display()}, clock), blaze(),
                    step_config, rate_hz, clock, metrics);
  DrawnTouches drawn({1280, 720}, 1);
  ContactTracker tracker;
  TouchEventBuilder builder("0123456789abcdef0123456789abcdef");
  BodyMap map = body_map_on(drawn.touched.screen);
  NobodyTouched nobody;
  Figure alone{"face.touch_path_1280x720.face_off", "ms"};
  Figure beside{"face.touch_path_1280x720.face_on", "ms"};
  cv::Mat picture;
  Timestamp time{};
  // As a camera of 30 Hz: a second with the face step, a second without.
  for (int second = -2; second < 40; ++second) {
    const bool face = second % 2 != 0;
    worker.want(face);
    for (int frame = 0; frame < 30; ++frame) {
      const auto next = std::chrono::steady_clock::now() + 33ms;
      drawn.touched.pictures[static_cast<std::size_t>(frame) % drawn.touched.pictures.size()].copyTo(picture);
      time += 33ms;
      Stopwatch watch;
      const Fingers& fingers = drawn.detector.detect(picture);
      const TouchedPoints touched =
          screen_points(fingers, drawn.touched.model, drawn.touched.screen, drawn.touched.image);
      const ContactStates& contacts = tracker.update(touched.fingers, time);
      BodyMap newest;
      worker.update(newest);
      builder.build(boxes_under(contacts, map, Duration::max(), time, nobody), map.version, time, time);
      const double ms = watch.lap_ms();
      if (second >= 0) (face ? beside : alone).samples.push_back(ms);
      std::this_thread::sleep_until(next);
    }
  }
  return {alone, beside};
}

}  // namespace telehug
