// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_tuning.hpp"

#include <linux/v4l2-controls.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace telehug {
namespace {

constexpr std::array<std::uint32_t, 5> tunable{V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CID_GAIN, V4L2_CID_BRIGHTNESS,
                                               V4L2_CID_CONTRAST, V4L2_CID_SATURATION};

bool by_factors(const CameraControl& control) {
  return control.id == V4L2_CID_EXPOSURE_ABSOLUTE && control.minimum > 0;
}

// The value at a part (0..1) of the control's range, on its grid of steps.
std::int32_t value_at(const CameraControl& control, double part) {
  const double least = control.minimum;
  const double most = control.maximum;
  const double wanted = by_factors(control) ? least * std::pow(most / least, part) : least + (most - least) * part;
  const double step = std::max(1, control.step);
  return static_cast<std::int32_t>(
      std::lround(std::clamp(least + std::round((wanted - least) / step) * step, least, most)));
}

double part_of(const CameraControl& control, std::int32_t value) {
  const double least = control.minimum;
  const double most = control.maximum;
  if (most <= least) return 0;
  const double at = std::clamp<double>(value, least, most);
  return by_factors(control) ? std::log(at / least) / std::log(most / least) : (at - least) / (most - least);
}

class Search {
 public:
  Search(const std::vector<CameraControl>& controls, const SetControl& set, const MeasureScene& measure,
         const TuningOptions& options, const Clock& clock)
      : controls_(controls),
        set_(set),
        measure_(measure),
        options_(options),
        clock_(clock),
        end_(clock.now() + options.longest) {
    for (const CameraControl& control : controls)
      tuning_.values.push_back({control.id, std::clamp(control.value, control.minimum, control.maximum)});
  }

  Result<Tuning> run() {
    set_all();
    const auto before = score();
    if (!before) return no_picture();
    tuning_.before = tuning_.after = *before;
    for (int round = 0; round < options_.rounds; ++round) {
      for (std::size_t i = 0; i < controls_.size() && !ended_; ++i) {
        tune(i, round);
        tell_progress(static_cast<std::size_t>(round) * controls_.size() + i + 1, 0);
      }
    }
    set_all();
    tuning_.complete = !out_of_time_ && !ended_;
    tuning_.ended = ended_;
    if (lost_) return no_picture();
    return tuning_;
  }

 private:
  static Error no_picture() { return {"no picture came from the camera; plug it in and tune again"}; }

  void tune(std::size_t index, int round) {
    const CameraControl& control = controls_[index];
    const double centre = part_of(control, tuning_.values[index].value);
    const double width = 1 / std::pow(static_cast<double>(options_.steps), round);
    std::vector<std::int32_t> tried{tuning_.values[index].value};
    const double first = round == 0 ? 0 : centre - width / 2;
    for (int step = 0; step <= options_.steps && !ended_; ++step) {
      tell_progress(static_cast<std::size_t>(round) * controls_.size() + index,
                    static_cast<double>(step) / (options_.steps + 1));
      if (ended_) break;
      const std::int32_t value = value_at(control, std::clamp(first + width * step / options_.steps, 0.0, 1.0));
      if (std::ranges::find(tried, value) != tried.end()) continue;
      tried.push_back(value);
      const std::int32_t best = tuning_.values[index].value;
      tuning_.values[index].value = value;
      (void)set_(tuning_.values[index]);  // a camera that is gone, or refuses it, shows in the score
      const auto reached = score();
      if (reached && *reached > tuning_.after + options_.least_gain * std::abs(tuning_.after)) {
        tuning_.after = *reached;
      } else {
        tuning_.values[index].value = best;
      }
      if (!reached) return;
    }
    (void)set_(tuning_.values[index]);
  }

  // `controls`: how many are done, over all rounds, and how much of the next one.
  void tell_progress(std::size_t controls, double part) {
    if (ended_ || !options_.progress) return;
    const double all = static_cast<double>(options_.rounds) * static_cast<double>(controls_.size());
    done_ = (static_cast<double>(controls) + part) / all;
    ended_ = !options_.progress(done_);
  }

  // Waits for the camera if it is gone: measuring takes time then.
  std::optional<double> score() {
    while (clock_.now() < end_ && !ended_) {
      if (const auto measured = measure_()) {
        if (!lost_) {
          ++tuning_.measurements;
          return measured;
        }
        lost_ = false;  // it came back with settings of its own
        set_all();
        continue;
      }
      lost_ = true;
      if (options_.progress) ended_ = !options_.progress(done_);
    }
    out_of_time_ = !ended_;
    return std::nullopt;
  }

  void set_all() {
    for (const ControlValue& value : tuning_.values)
      (void)set_(value);
  }

  const std::vector<CameraControl>& controls_;
  const SetControl& set_;
  const MeasureScene& measure_;
  const TuningOptions& options_;
  const Clock& clock_;
  Timestamp end_;
  Tuning tuning_;
  bool lost_ = false;
  bool out_of_time_ = false;
  bool ended_ = false;
  double done_ = 0;
};

}  // namespace

std::vector<CameraControl> tunable_controls(const std::vector<CameraControl>& controls, double fps) {
  std::vector<CameraControl> chosen;
  for (const std::uint32_t id : tunable) {
    const auto control = std::ranges::find(controls, id, &CameraControl::id);
    if (control == controls.end() || control->maximum <= control->minimum) continue;
    chosen.push_back(*control);
    if (id != V4L2_CID_EXPOSURE_ABSOLUTE) continue;
    const auto one_frame = static_cast<std::int32_t>(10'000 / std::max(1.0, fps));
    chosen.back().maximum = std::clamp(one_frame, control->minimum + 1, control->maximum);
  }
  return chosen;
}

Result<Tuning> tune_camera(const std::vector<CameraControl>& controls, const SetControl& set,
                           const MeasureScene& measure, const TuningOptions& options, const Clock& clock) {
  return Search(controls, set, measure, options, clock).run();
}

}  // namespace telehug
