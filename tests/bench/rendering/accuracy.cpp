// SPDX-License-Identifier: Apache-2.0
#include "bench/rendering/accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "rendering/geometry.hpp"
#include "rendering/jacket_renderer.hpp"
#include "rendering/motor_mesh.hpp"
#include "safety/intensity.hpp"

namespace telehug {
namespace {

constexpr int rows = 4;

// How strong the motor is felt (0..1), from what it is told.
double amplitude(const Actuator& actuator, double strength, Seen seen) {
  if (seen == Seen::drives) return std::pow(strength, 1 / actuator.gamma);
  const IntensityScale scale(actuator.min_strength, actuator.max_strength);
  const double least = scale.intensity(1e-9);
  const double most = scale.intensity(1);
  const double told = scale.intensity(strength);
  if (told == 0 || most <= least) return told > 0 ? 1 : 0;
  return std::pow((told - least) / (most - least), 1 / actuator.gamma);
}

std::optional<BodyPoint> centre(const Drives& drives, const JacketProfile& profile, Seen seen) {
  double energy = 0;
  BodyPoint sum;
  for (const Drive& drive : drives) {
    const Actuator& actuator = profile.actuators.at(profile.index_of(drive.actuator).value());
    const double own = std::pow(amplitude(actuator, drive.strength, seen), 2);
    energy += own;
    sum.x_fh += own * actuator.place.x_fh;
    sum.y_fh += own * actuator.place.y_fh;
  }
  if (energy <= 0) return std::nullopt;
  return BodyPoint{sum.x_fh / energy, sum.y_fh / energy};
}

}  // namespace

double FeltPlace::error_fh() const {
  return distance_fh(touch, felt.value());
}

std::vector<FeltPlace> measure_accuracy(const JacketProfile& profile, Seen seen, double step_fh) {
  JacketProfile steady = profile;  // after the motors' start
  for (Actuator& actuator : steady.actuators)
    actuator.kick = {};
  JacketRenderer renderer(steady, std::chrono::milliseconds(200));
  const MotorMesh mesh(steady, BodySide::front);
  const double right_fh = standard_columns * standard_box_side_fh / 2;
  const double bottom_fh = rows * standard_box_side_fh;

  std::vector<FeltPlace> places;
  TouchEvent event;
  event.contacts.emplace_back();
  Contact& contact = event.contacts[0];
  for (double y_fh = step_fh / 2; y_fh < bottom_fh; y_fh += step_fh) {
    for (double x_fh = -right_fh + step_fh / 2; x_fh < right_fh; x_fh += step_fh) {
      contact.body = {x_fh, y_fh};
      renderer.reset();
      const Drives& drives = renderer.plan(event, {}, {}).drives;
      places.push_back({contact.body, mesh.inside(contact.body), centre(drives, steady, seen)});
    }
  }
  return places;
}

AccuracySummary summarise(const std::vector<FeltPlace>& places, bool between_motors_only) {
  AccuracySummary made;
  std::vector<double> errors_fh;
  for (const FeltPlace& place : places) {
    if (between_motors_only && !place.between_motors) continue;
    ++made.touches;
    if (place.felt) {
      errors_fh.push_back(place.error_fh());
    } else {
      ++made.uncovered;
    }
  }
  if (errors_fh.empty()) return made;
  std::ranges::sort(errors_fh);
  const auto percentile = [&](double part) {
    return errors_fh[static_cast<std::size_t>(part * static_cast<double>(errors_fh.size() - 1))];
  };
  for (const double error_fh : errors_fh)
    made.mean_fh += error_fh / static_cast<double>(errors_fh.size());
  made.median_fh = percentile(0.5);
  made.p99_fh = percentile(0.99);
  made.most_fh = errors_fh.back();
  return made;
}

}  // namespace telehug
