// SPDX-License-Identifier: Apache-2.0
#include "touch/contact_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace telehug {
namespace {

// One in ten widths is anything: a fingertip that barely shows is measured too narrow, a shadow may join it.
constexpr double wild_widths = 0.1;
constexpr double wild_width_density = 0.7;

double normal(double error, double sd) {
  const double z = error / sd;
  return std::exp(-0.5 * z * z) / (sd * std::sqrt(2 * std::numbers::pi));
}

// Of a value from an exponential distribution (which is >= 0), measured with noise; to first order.
double exponential(double value, double mean, double noise) {
  if (value < 0) return std::exp(-0.5 * value * value / (noise * noise)) / mean * 0.5;
  return std::exp(-value / mean) / mean;
}

// Of a value spread evenly from 0 to `most`, either sign, measured with noise.
double even(double value, double most, double noise) {
  const double low = std::min(0.0, most);
  const double high = std::max(0.0, most);
  const double outside = std::max({low - value, value - high, 0.0});
  const double z = outside / noise;
  return std::exp(-0.5 * z * z) / (high - low + noise * std::sqrt(2 * std::numbers::pi));
}

double width_fits(double error, double sd) {
  return (1 - wild_widths) * normal(error, sd) + wild_widths * wild_width_density;
}

double sum(const std::array<double, 3>& states) {
  return states[0] + states[1] + states[2];
}

template <typename States>
void normalise(States& states) {
  constexpr double least = 1e-9;  // never quite sure: a state can come back
  for (double& state : states)
    state = std::max(state, least * sum(states));
  const double total = sum(states);
  for (double& state : states)
    state /= total;
}

}  // namespace

ContactFilter::ContactFilter(const CameraFoot& camera, const ContactFilterOptions& options, const FingerWidth& known,
                             const FingerObservation& first, std::optional<double> seconds_unseen)
    : camera_(camera), options_(options), belief_{0.6, 0.39, 0.01} {
  remember(first);
  const bool beside_edge = seconds_unseen && *seconds_unseen > 0 && came_over_border(*seconds_unseen);
  weigh_mirror(first.mirror, beside_edge ? options_.most_mirror_log_ratio : options_.first_mirror_log_ratio);
  weigh_width(first, known);
}

// It was not there a frame ago, so it came over the bottom edge since: with at least this speed. True if it did not
// come far: then it may have landed before it could be seen.
bool ContactFilter::came_over_border(double seconds) {
  constexpr double slowest_mm_s = 200;    // mean of hands that come
  constexpr double fastest_mm_s = 1000;   // what appears faster was there before, or is no hand
  constexpr double beside_edge_mm = 2.5;  // a hand falls farther within a frame
  constexpr double a_frame_s = 1.0 / 30;
  const double border_mm = camera_.screen_bottom_mm - camera_.foot.y_mm;
  const double y_mm = std::max(1.0, last_.screen.y_mm - camera_.foot.y_mm);
  const double way = std::log(std::max(1.0, border_mm / y_mm));
  const double speed = way / seconds;
  if (speed * camera_.height_mm > fastest_mm_s) return false;
  log_r_speed_ = -std::max(speed, slowest_mm_s / camera_.height_mm);
  // It may have landed since. But what nobody saw coming may be no finger at all.
  const double landed = 0.25 * options_.land_rate * std::min(seconds, a_frame_s);
  belief_ = {0.97 - landed, 0.03, landed};
  return way * camera_.height_mm < beside_edge_mm;
}

double ContactFilter::noise_mm(const FingerObservation& finger) const {
  const double px = options_.tip_noise_px / std::clamp(finger.quality, 0.1, 1.0);
  return finger.px_per_mm > 0 ? px / finger.px_per_mm : 0.2 * px;
}

ContactFilter::Step ContactFilter::step_to(const FingerObservation& finger, double seconds) const {
  const double x0 = last_.screen.x_mm - camera_.foot.x_mm;
  const double y0 = last_.screen.y_mm - camera_.foot.y_mm;
  const double x1 = finger.screen.x_mm - camera_.foot.x_mm;
  const double y1 = finger.screen.y_mm - camera_.foot.y_mm;
  const double r0 = std::max(1.0, std::hypot(x0, y0));
  const double r1 = std::max(1.0, std::hypot(x1, y1));
  Step step;
  step.seconds = seconds;
  step.log_r = std::log(r1 / r0);
  step.radial_mm = r0 * step.log_r;
  step.across_mm = (x1 * y0 - y1 * x0) / r1;
  // The picture is foreshortened by y / z0.
  step.noise_across_mm = std::numbers::sqrt2 * std::hypot(noise_mm(finger), 0.3);
  step.noise_radial_mm = std::max(1.0, r1 / camera_.height_mm) * std::numbers::sqrt2 * noise_mm(finger) + 0.3;
  if (finger.width_mm > 0 && last_.width_mm > 0) step.width = std::log(finger.width_mm / last_.width_mm);
  return step;
}

// At rest, or a stroke that goes on, or one that begins.
double ContactFilter::rests_or_slides(const Step& step, double extra_radial_mm) const {
  const double radial = std::hypot(step.noise_radial_mm, extra_radial_mm);
  const double across = step.noise_across_mm;
  const double turns = options_.slide_mm_s2 * step.seconds * step.seconds;
  const double begins = options_.slide_mm_s * step.seconds;
  const double last_too = std::numbers::sqrt3;  // the speed so far is as noisy as the step
  const double t = step.seconds;
  return 0.4 * normal(step.radial_mm, radial) * normal(step.across_mm, across) +
         0.4 * normal(step.radial_mm - radial_mm_s_ * t, std::hypot(last_too * radial, turns)) *
             normal(step.across_mm - across_mm_s_ * t, std::hypot(last_too * across, turns)) +
         0.2 * normal(step.radial_mm, std::hypot(radial, begins)) * normal(step.across_mm, std::hypot(across, begins));
}

// [from][to]: how likely the change, and what was seen of it.
std::array<ContactFilter::States, 3> ContactFilter::transitions(const Step& step) const {
  const double t = step.seconds;
  const double z0 = camera_.height_mm;
  const double r = std::max(1.0, radius_mm_);
  const double noise = step.noise_radial_mm / r;
  const double near_z0 = 0.7 * z0;  // z0 - h, of fingers near the screen

  const double width_sd = std::numbers::sqrt2 * options_.width_noise;
  const double same_width = step.width ? width_fits(*step.width, width_sd) : 1;
  const double height_width =
      step.width ? width_fits(*step.width - step.log_r, std::hypot(width_sd, 0.25 * step.log_r)) : 1;

  const double slow_across = 0.5 * normal(step.across_mm, step.noise_across_mm) +
                             0.5 * normal(step.across_mm, std::hypot(step.noise_across_mm, options_.across_mm_s * t));
  const double same_across =
      normal(step.across_mm - across_mm_s_ * t,
             std::hypot(std::numbers::sqrt3 * step.noise_across_mm, options_.slide_mm_s2 * t * t));
  const double air = options_.air_mm_s2 * t * t / near_z0;
  const double expected = log_r_speed_.value_or(0) * t;

  // With what speed it came nearer (1/s times z0 - h), and which end of the motion that suggests.
  const double closing_mm_s = log_r_speed_ ? -*log_r_speed_ * near_z0 : 0;
  const double squared = closing_mm_s > 0 ? closing_mm_s * closing_mm_s : 0;
  const double impact = squared / (squared + options_.impact_mm_s * options_.impact_mm_s);

  const double land = log_r_speed_ ? options_.land_rate * t * impact : 0.005;
  const double halt = options_.halt_rate * t * (log_r_speed_ ? 1.3 - impact : 1);
  const double lift = options_.lift_rate * t;
  const double slow = 0.5 * t;  // pressing on from hovering, giving way to it

  const double keeps_moving =
      log_r_speed_ ? normal(step.log_r - expected, std::hypot(air, noise)) : normal(step.log_r, 0.4);
  const double lands =
      log_r_speed_ ? even(step.log_r, std::min(0.0, 1.1 * expected), noise + 0.01) : normal(step.log_r, 0.05);
  const double halts = log_r_speed_
                           ? normal(step.log_r, std::hypot(0.06, noise)) *
                                 std::exp(-0.5 * std::pow((step.log_r - expected) / std::hypot(0.7 * air, noise), 2))
                           : normal(step.log_r, 0.1);
  const double lifts = exponential(step.log_r, options_.lift_mm_s * t / z0, noise + 0.01);
  const double drift_mm = options_.drift_mm_s * t * r / near_z0;
  const double creep = 60 * t / near_z0;

  const double in_air = height_width / r;  // densities over log r become ones over mm
  std::array<States, 3> p{};
  p[moving_state][moving_state] = (1 - land - halt) * keeps_moving * same_across * in_air;
  p[moving_state][hovering_state] = halt * halts * slow_across * in_air;
  p[moving_state][touching_state] = land * lands * slow_across * in_air;
  p[hovering_state][moving_state] = lift * normal(step.log_r, 0.3) * slow_across * in_air;
  p[hovering_state][hovering_state] = (1 - lift - slow) * rests_or_slides(step, drift_mm) * same_width;
  p[hovering_state][touching_state] = slow * exponential(-step.log_r, creep, noise) * slow_across * in_air;
  p[touching_state][moving_state] = lift * lifts * slow_across * in_air;
  p[touching_state][hovering_state] = slow * exponential(step.log_r, creep, noise) * slow_across * in_air;
  p[touching_state][touching_state] = (1 - lift - slow) * rests_or_slides(step, 0) * same_width;
  return p;
}

void ContactFilter::update(const FingerObservation& finger, double seconds, const FingerWidth& known) {
  if (!comparable_) {
    remember(finger);
    return;
  }
  if (seconds > 0) {
    const Step step = step_to(finger, seconds);
    const auto p = transitions(step);
    States next{};
    for (std::size_t from = 0; from < next.size(); ++from) {
      for (std::size_t to = 0; to < next.size(); ++to)
        next[to] += belief_[from] * p[from][to];
    }
    // Nothing explains such a leap: it tells nothing.
    if (sum(next) > 1e-30) belief_ = next;
    normalise(belief_);
    log_r_speed_ = step.log_r / seconds;
    radial_mm_s_ = step.radial_mm / seconds;
    across_mm_s_ = step.across_mm / seconds;
  }
  weigh_mirror(finger.mirror, options_.most_mirror_log_ratio);
  remember(finger);
  weigh_width(finger, known);
}

void ContactFilter::skip(const FingerObservation& finger) {
  remember(finger);
  comparable_ = false;
  log_r_speed_.reset();
  radial_mm_s_ = across_mm_s_ = 0;
}

double ContactFilter::touching_unseen(int frames, double seconds) const {
  const double border_mm = camera_.screen_bottom_mm - camera_.foot.y_mm;
  const double y_mm = last_.screen.y_mm - camera_.foot.y_mm;
  const double hidden_from_mm = std::max(0.0, camera_.height_mm * (1 - y_mm / border_mm));
  const double lifted = options_.lift_rate * seconds * std::exp(-hidden_from_mm / (options_.lift_mm_s * seconds));
  // Where one frame missed it, the next one may, too.
  const double missed = options_.dropout * std::pow(0.5, frames - 1);
  const double touched = touching();
  return touched * missed / (touched * (missed + lifted) + (1 - touched) + 1e-12);
}

std::optional<double> ContactFilter::width() const noexcept {
  if (widths_ == 0) return std::nullopt;
  return width_sum_ / widths_;
}

void ContactFilter::weigh_mirror(const MirrorEvidence& mirror, double most_log_ratio) {
  if (mirror.state == MirrorState::unknown) return;
  const double unlikely = std::exp(-std::clamp(mirror.log_ratio, 0.0, most_log_ratio));
  const bool touching = mirror.state == MirrorState::touching;
  belief_[touching_state] *= touching ? 1 : unlikely;
  belief_[moving_state] *= touching ? unlikely : 1;
  belief_[hovering_state] *= touching ? unlikely : 1;
  normalise(belief_);
}

// Not accumulated like the rest: that a finger is wide stays the same news in every frame. So the mean width since it
// came to rest or touched is weighed anew.
void ContactFilter::weigh_width(const FingerObservation& finger, const FingerWidth& known) {
  probability_ = belief_;
  if (!(finger.width_mm > 0)) return;
  if (moving()) {
    width_sum_ = 0;
    widths_ = 0;
  }
  width_sum_ += std::log(finger.width_mm);
  ++widths_;
  const double too_wide = width_sum_ / widths_ - known.log_mm;
  const double sd = std::hypot(known.sd, options_.width_noise / std::sqrt(widths_));
  // Hovering hands are 5 to 30 mm away, moving ones anywhere up to the camera.
  probability_[touching_state] *= width_fits(too_wide, sd);
  probability_[hovering_state] *= width_fits(too_wide - 0.4, std::hypot(sd, 0.2));
  probability_[moving_state] *= width_fits(too_wide - 0.4, std::hypot(sd, 0.3));
  normalise(probability_);
}

void ContactFilter::remember(const FingerObservation& finger) {
  last_ = finger;
  radius_mm_ = std::hypot(finger.screen.x_mm - camera_.foot.x_mm, finger.screen.y_mm - camera_.foot.y_mm);
  comparable_ = true;
}

}  // namespace telehug
