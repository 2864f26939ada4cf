// SPDX-License-Identifier: Apache-2.0
#include "finger/tip_contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace telehug {
namespace {

constexpr float region_weight = 0.9F;  // of one half width of pixels that are all finger, or all not
constexpr float edge_weight = 1.6F;
constexpr float shape_weight = 0.35F;  // of the squared logarithm of the distance, against a round tip
constexpr float bend_cost = 2.1F;      // of one half width between neighbouring angles
constexpr float largest_bend = 0.15F;  // between two angles, in half widths
constexpr double nearest = 0.3;        // distances looked at, in half widths
constexpr double farthest = 2.1;
constexpr double centre_behind_tip = 0.95;
constexpr float half_step = 15;              // grey levels of an edge of strength 0.5
constexpr float inside_distance2 = 60 * 60;  // squared distance from the finger's colours at which an edge counts half
constexpr double guess_weight = 0.5;         // of what the search along the finger saw
// A rim of skin about a nail is up to so wide, in half widths, looks on the whole so much like finger, and has an edge.
constexpr float rim_width = 0.25F;
constexpr float rim_likeness = 0.5F;
constexpr float rim_edge = 0.3F;
constexpr double inside_share = 0.7;  // how far out the tip's own colours are learned
constexpr std::size_t margin = 4;     // samples before and after a ray's radii

double angle_of(std::size_t index) {
  return (-100 + 4 * static_cast<double>(index)) * std::numbers::pi / 180;
}

// Of a round tip on a straight finger.
double usual_radius(double angle, double half_width_px) {
  return std::abs(angle) < 1.2 ? half_width_px : half_width_px / std::max(0.8, std::abs(std::sin(angle)));
}

Colour mean(const Colour& x, const Colour& y) {
  return {0.5F * (x.b + y.b), 0.5F * (x.g + y.g), 0.5F * (x.r + y.r)};
}

}  // namespace

TipContourFinder::TipContourFinder()
    : ray_(most_radii + 2 * margin),
      log_radius_(most_radii),
      edge_(TipContour::angles * most_radii),
      sharp_(edge_.size()),
      like_(edge_.size()),
      cost_(edge_.size()),
      path_cost_(edge_.size()),
      came_from_(edge_.size()) {
  inside_.reserve(TipContour::angles * 5);
}

void TipContourFinder::sample_ray(const cv::Mat& bgr, const Centre& centre, const Grid& grid, std::size_t angle,
                                  std::size_t radii) {
  const double sine = std::sin(angle_of(angle));
  const double cosine = std::cos(angle_of(angle));
  const double first = nearest * centre.half_width_px - static_cast<double>(margin) * grid.radius_step_px;
  const auto last_u = static_cast<float>(bgr.cols) - 1.01F;
  const auto last_v = static_cast<float>(bgr.rows) - 1.01F;
  for (std::size_t i = 0; i < radii + 2 * margin; ++i) {
    const double r = first + static_cast<double>(i) * grid.radius_step_px;
    ray_[i] = colour_at(bgr, std::clamp(static_cast<float>(centre.u + r * sine), 0.0F, last_u),
                        std::clamp(static_cast<float>(centre.v + r * cosine), 0.0F, last_v));
  }
}

// The edge of a nail or of polish may be stronger than that of the rim of skin about it.
std::size_t TipContourFinder::outer_edge(std::size_t row, std::size_t inner, std::size_t last) const {
  const float* const like = like_.data() + row * most_radii;
  const float* const edge = edge_.data() + row * most_radii;
  std::size_t best = inner;
  float sum = 0;
  for (std::size_t i = inner + 1; i <= last; ++i) {
    sum += like[i];
    if (sum < rim_likeness * static_cast<float>(i - inner)) break;
    if (i < inner + 2 || edge[i] < rim_edge || edge[i] < edge[i - 1] || edge[i] < edge[i + 1]) continue;
    best = i;
  }
  return best;
}

TipContour TipContourFinder::trace(const cv::Mat& bgr, const Centre& centre, const Grid& grid, FingerColours& colours) {
  const double a = centre.half_width_px;
  const auto radii =
      std::min(most_radii, static_cast<std::size_t>(std::lround((farthest - nearest) * a / grid.radius_step_px)) + 1);
  const auto step = static_cast<float>(grid.radius_step_px / a);  // in half widths
  // An edge lies between what is 1 to 4 px inside it and what is 1 to 4 px outside.
  const std::size_t near = grid.radius_step_px > 1.5 ? 1 : 2;
  const std::size_t far = grid.radius_step_px > 1.5 ? 2 : 3;
  const auto reach = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(largest_bend * static_cast<float>(grid.angle_step) / step)));

  for (std::size_t i = 0; i < radii; ++i)
    log_radius_[i] = static_cast<float>(std::log(nearest * a + static_cast<double>(i) * grid.radius_step_px));
  std::size_t rows = 0;
  for (std::size_t angle = 0; angle < TipContour::angles; angle += grid.angle_step, ++rows) {
    sample_ray(bgr, centre, grid, angle, radii);
    const double cosine = std::cos(angle_of(angle));
    const auto log_usual = static_cast<float>(std::log(usual_radius(angle_of(angle), a)));
    float* const cost = cost_.data() + rows * most_radii;
    float* const edge = edge_.data() + rows * most_radii;
    float* const sharp = sharp_.data() + rows * most_radii;
    float* const like = like_.data() + rows * most_radii;
    float region = 0;
    for (std::size_t i = 0; i < radii; ++i) {
      const std::size_t at = i + margin;
      const double r = nearest * a + static_cast<double>(i) * grid.radius_step_px;
      like[i] = colours.likeness(ray_[at], static_cast<int>(std::lround(centre.v + r * cosine)));
      region += step * like[i];
      sharp[i] = distance2(mean(ray_[at - 1], ray_[at - 2]), mean(ray_[at + 1], ray_[at + 2]));
      const Colour inside = mean(ray_[at - near], ray_[at - far]);
      const Colour outside = mean(ray_[at + near], ray_[at + far]);
      const float difference = std::sqrt(distance2(inside, outside));
      edge[i] = difference / (difference + half_step);
      const float unlike = colours.from_finger2(inside) / inside_distance2;
      edge[i] /= 1 + unlike * unlike;
      const float bulge = log_radius_[i] - log_usual;
      cost[i] = -region_weight * region - edge_weight * edge[i] + shape_weight * bulge * bulge;
    }
  }

  const float bend = bend_cost * step / static_cast<float>(grid.angle_step);
  std::copy_n(cost_.begin(), radii, path_cost_.begin());
  for (std::size_t row = 1; row < rows; ++row) {
    const float* const before = path_cost_.data() + (row - 1) * most_radii;
    float* const now = path_cost_.data() + row * most_radii;
    for (std::size_t i = 0; i < radii; ++i) {
      const std::size_t first = i > reach ? i - reach : 0;
      const std::size_t last = std::min(radii - 1, i + reach);
      float least = std::numeric_limits<float>::max();
      std::size_t from = i;
      for (std::size_t k = first; k <= last; ++k) {
        const float c = before[k] + bend * static_cast<float>(k > i ? k - i : i - k);
        from = c < least ? k : from;
        least = std::min(c, least);
      }
      now[i] = least + cost_[row * most_radii + i];
      came_from_[row * most_radii + i] = static_cast<std::uint8_t>(from);
    }
  }

  TipContour contour;
  const float* const end = path_cost_.data() + (rows - 1) * most_radii;
  auto i = static_cast<std::size_t>(std::min_element(end, end + radii) - end);
  contour.score = -static_cast<double>(end[i]) / static_cast<double>(rows);
  std::array<double, TipContour::angles> radius{};
  for (std::size_t row = rows; row-- > 0;) {
    const std::size_t on_path = i;
    if (grid.angle_step == 1)
      i = outer_edge(row, i, std::min(radii - 3, i + static_cast<std::size_t>(rim_width / step)));
    // To parts of a step: the centre of the change of colour about the path.
    const float* const sharp = sharp_.data() + row * most_radii;
    const std::size_t first = i > 1 ? i - 2 : 0;
    const std::size_t last = std::min(radii - 1, i + 2);
    const float floor = 0.5F * *std::max_element(sharp + first, sharp + last + 1);
    float sum = 0;
    float moment = 0;
    for (std::size_t k = first; k <= last; ++k) {
      const float weight = std::max(0.0F, sharp[k] - floor);
      sum += weight;
      moment += weight * static_cast<float>(k);
    }
    const double exact = sum > 0 ? static_cast<double>(moment / sum) : static_cast<double>(i);
    radius[row * grid.angle_step] = nearest * a + exact * grid.radius_step_px;
    contour.edge[row * grid.angle_step] = edge_[row * most_radii + i];
    i = came_from_[row * most_radii + on_path];
  }
  for (std::size_t k = 0; k < TipContour::angles; ++k) {
    if (k % grid.angle_step != 0) {
      radius[k] = 0.5 * (radius[k - 1] + radius[k + 1]);
      contour.edge[k] = contour.edge[k - 1];
    }
    contour.points[k] = {centre.u + radius[k] * std::sin(angle_of(k)), centre.v + radius[k] * std::cos(angle_of(k))};
  }
  return contour;
}

void TipContourFinder::learn_tip(const cv::Mat& bgr, const Centre& centre,
                                 const std::array<double, TipContour::angles>& radius, bool guessed,
                                 FingerColours& colours) {
  constexpr std::array<double, 5> shares{0.15, 0.35, 0.55, 0.75, 1.0};
  const auto last_u = static_cast<float>(bgr.cols) - 1.01F;
  const auto last_v = static_cast<float>(bgr.rows) - 1.01F;
  inside_.clear();
  for (std::size_t k = 0; k < TipContour::angles; k += 2) {
    for (const double share : shares) {
      const double r = share * inside_share * radius[k];
      const double u = centre.u + r * std::sin(angle_of(k));
      const double v = centre.v + r * std::cos(angle_of(k));
      inside_.push_back(colour_at(bgr, std::clamp(static_cast<float>(u), 0.0F, last_u),
                                  std::clamp(static_cast<float>(v), 0.0F, last_v)));
    }
  }
  colours.learn_tip(inside_, guessed);
}

// Every guess is looked at coarsely, all but the least sure one finely.
TipContour TipContourFinder::find(const cv::Mat& bgr, const TipSearch::Guesses& guesses, FingerColours& colours) {
  constexpr std::size_t finely = 2;
  static_assert(TipSearch::most_guesses == finely + 1);
  // What the search saw counts too: a nail's root looks like a tip, but the finger's sides go on beyond it.
  boost::container::static_vector<Look, TipSearch::most_guesses> looks;
  for (const TipGuess& guess : guesses)
    looks.push_back(first_look(bgr, guess, colours));
  if (looks.size() > finely) {
    looks.erase(std::min_element(looks.begin(), looks.end(),
                                 [](const Look& x, const Look& y) { return x.sureness() < y.sureness(); }));
  }
  TipContour best;
  double surest = -std::numeric_limits<double>::max();
  for (Look& look : looks) {
    look.contour = close_look(bgr, look, colours);
    if (look.sureness() > surest) {
      surest = look.sureness();
      best = look.contour;
    }
  }
  return best;
}

TipContourFinder::Look TipContourFinder::first_look(const cv::Mat& bgr, const TipGuess& guess, FingerColours& colours) {
  constexpr Grid coarse{2, 2};
  Look look;
  Centre& centre = look.centre;
  centre.half_width_px = guess.finger_half_width_px;
  centre.v = guess.tip_v - centre_behind_tip * centre.half_width_px;
  centre.u = guess.root_u + guess.lean * (centre.v - guess.root_v);
  std::array<double, TipContour::angles> radius;
  for (std::size_t k = 0; k < radius.size(); ++k)
    radius[k] = usual_radius(angle_of(k), centre.half_width_px);
  learn_tip(bgr, centre, radius, true, colours);
  look.contour = trace(bgr, centre, coarse, colours);
  look.guess_sureness = guess_weight * guess.strength;
  return look;
}

TipContour TipContourFinder::close_look(const cv::Mat& bgr, const Look& look, FingerColours& colours) {
  const TipContour& first = look.contour;
  Centre centre = look.centre;
  std::array<double, TipContour::angles> radius;
  for (std::size_t k = 0; k < radius.size(); ++k)
    radius[k] = std::hypot(first.points[k].u_px - centre.u, first.points[k].v_px - centre.v);
  learn_tip(bgr, centre, radius, false, colours);

  // Again about the middle of what was found.
  double tip_v = first.points[0].v_px;
  for (const ImagePoint& point : first.points)
    tip_v = std::max(tip_v, point.v_px);
  double left = std::numeric_limits<double>::max();
  double right = -left;
  for (const ImagePoint& point : first.points) {
    if (point.v_px < tip_v - 1.3 * centre.half_width_px) continue;
    left = std::min(left, point.u_px);
    right = std::max(right, point.u_px);
  }
  centre.u = 0.5 * (left + right);
  centre.v = tip_v - centre_behind_tip * centre.half_width_px;
  return trace(bgr, centre, {1, std::max(1.0, (farthest - nearest) * centre.half_width_px / (most_radii - 1))},
               colours);
}

}  // namespace telehug
