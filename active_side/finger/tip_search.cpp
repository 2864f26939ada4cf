// SPDX-License-Identifier: Apache-2.0
#include "finger/tip_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace telehug {
namespace {

// Half ellipses: seen from above a fingertip is 0.7 to 1.35 half widths long, a long nail makes it longer.
constexpr std::array<double, 5> lengths{0.7, 1.0, 1.35, 1.8, 2.3};
constexpr double longest_usual = 1.35;
constexpr double rare_cost = 0.06;  // longer ones need that much more evidence
constexpr int outline_points = 25;
constexpr std::array<double, 3> leans{-0.4, 0, 0.4};  // of the tip against the finger
constexpr std::array<double, 2> widths{1.0, 0.88};    // of the tip against the finger
constexpr std::array<double, 1> first_widths{1.0};    // at the first look
constexpr double sides_weight = 0.4;                  // the straight finger behind the tip must have sides,
constexpr double beyond_weight = 0.35;                // and none beyond it
constexpr double in_front_px = 24;  // of the border: a touch at the screen's edge, seen by its whole tip
constexpr double step_px = 3;
constexpr double apart_px = 10;
constexpr int rows_per_sum = 2;  // as many as a cell of the edge map

// Keeps the strongest guesses, and only the strongest of those that are close together.
template <typename Guesses>
void keep_strongest(Guesses& guesses, const TipGuess& guess, double apart) {
  const auto is_close = [&](const TipGuess& other) { return std::abs(other.tip_v - guess.tip_v) < apart; };
  const auto is_weaker = [](const TipGuess& x, const TipGuess& y) { return x.strength < y.strength; };
  for (const TipGuess& other : guesses) {
    if (is_close(other) && !is_weaker(other, guess)) return;
  }
  guesses.erase(std::remove_if(guesses.begin(), guesses.end(), is_close), guesses.end());
  if (guesses.size() < guesses.capacity()) {
    guesses.push_back(guess);
    return;
  }
  const auto weakest = std::min_element(guesses.begin(), guesses.end(), is_weaker);
  if (is_weaker(*weakest, guess)) *weakest = guess;
}

}  // namespace

TipSearch::TipSearch(ImageSize largest) : sides_(static_cast<std::size_t>(largest.height_px / rows_per_sum + 2)) {
  constexpr int dense = 400;
  for (const double length : lengths) {
    // Points at equal distances along the ellipse's arc.
    std::array<double, dense + 1> arc{};
    const auto at = [&](double angle) { return std::array{std::sin(angle), length * std::cos(angle)}; };
    const auto angle_of = [](double share) { return std::numbers::pi * (share - 0.5); };
    for (std::size_t i = 1; i <= dense; ++i) {
      const auto p = at(angle_of(static_cast<double>(i - 1) / dense));
      const auto q = at(angle_of(static_cast<double>(i) / dense));
      arc[i] = arc[i - 1] + std::hypot(q[0] - p[0], q[1] - p[1]);
    }
    Outline outline;
    outline.length = length;
    for (int i = 0; i < outline_points; ++i) {
      const double wanted = arc[dense] * i / (outline_points - 1);
      const auto found = std::lower_bound(arc.begin(), arc.end(), wanted) - arc.begin();
      const double angle = angle_of(static_cast<double>(found) / dense);
      const auto p = at(angle);
      const double nx = std::sin(angle);
      const double ny = std::cos(angle) / length;
      const double norm = std::hypot(nx, ny);
      outline.points.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(nx / norm),
                                static_cast<float>(ny / norm)});
    }
    outlines_.push_back(std::move(outline));
  }
}

void TipSearch::sum_sides(const EdgeMap& edges, const FingerAxis& axis, double last_v) {
  const auto slope = static_cast<float>(axis.slope());
  const auto last = std::min(sides_.size() - 1, static_cast<std::size_t>(std::max(0.0, last_v / rows_per_sum)) + 1);
  Sides sum;
  for (std::size_t i = 0; i <= last; ++i) {
    sides_[i] = sum;
    const double v = rows_per_sum * (static_cast<double>(i) + 0.5);
    const auto row = static_cast<float>(v);
    for (const double side : {-axis.half_width(v), axis.half_width(v)}) {
      const auto u = static_cast<float>(axis.centre_u(v) + side);
      const float exact = edges.strength(u, row, 1, -slope);
      sum.exact += static_cast<double>(exact);
      sum.nearly += static_cast<double>(
          std::max({edges.strength(u - 2, row, 1, -slope), exact, edges.strength(u + 2, row, 1, -slope)}));
    }
  }
  last_sum_ = last;
}

double TipSearch::mean_side(double Sides::*kind, double first_v, double last_v) const {
  const auto sum_to = [&](double v) {
    const double index = std::clamp(v / rows_per_sum, 0.0, static_cast<double>(last_sum_));
    return sides_[static_cast<std::size_t>(index)].*kind;
  };
  return (sum_to(last_v) - sum_to(first_v)) * rows_per_sum / (2 * (last_v - first_v));
}

TipSearch::Place TipSearch::place(const Outline& outline, const FingerAxis& axis, double tip_v) const {
  const double a = axis.half_width(tip_v - outline.length * axis.half_width(tip_v));
  const double root_v = tip_v - outline.length * a;
  const double behind = mean_side(&Sides::exact, root_v - 2 * a, root_v);
  const double beyond = mean_side(&Sides::nearly, tip_v, tip_v + a);
  const double rare = outline.length > longest_usual ? rare_cost : 0;
  return {a, sides_weight * behind - beyond_weight * beyond - rare};
}

TipGuess TipSearch::laid_over(const EdgeMap& edges, const Outline& outline, const Place& place, TipGuess guess,
                              double width, std::size_t point_step) {
  const double half_width = width * place.half_width_px;
  guess.finger_half_width_px = place.half_width_px;
  const auto u = static_cast<float>(guess.root_u);
  const auto v = static_cast<float>(guess.root_v);
  const auto a = static_cast<float>(half_width);
  const auto lean = static_cast<float>(guess.lean);
  float sum = 0;
  for (std::size_t i = 0; i < outline.points.size(); i += point_step) {
    const OutlinePoint& p = outline.points[i];
    const float along = p.y * a;
    sum += edges.strength(u + p.x * a + lean * along, v + along, p.nx, p.ny);
  }
  const std::size_t points = (outline.points.size() - 1) / point_step + 1;
  guess.strength = static_cast<double>(sum) / static_cast<double>(points) + place.evidence_beside;
  return guess;
}

TipGuess TipSearch::best_at(const EdgeMap& edges, const FingerAxis& axis, double tip_v, const Look& look) const {
  TipGuess best;
  best.strength = -1;
  for (const Outline& outline : outlines_) {
    const Place at = place(outline, axis, tip_v);
    for (const double width : look.widths) {
      TipGuess guess;
      guess.tip_v = tip_v;
      guess.root_v = tip_v - outline.length * width * at.half_width_px;
      guess.root_u = axis.centre_u(guess.root_v);
      for (const double extra_lean : look.leans) {
        guess.lean = axis.slope() + extra_lean;
        guess = laid_over(edges, outline, at, guess, width, look.point_step);
        if (guess.strength > best.strength) best = guess;
      }
    }
  }
  return best;
}

TipSearch::Guesses TipSearch::find(const EdgeMap& edges, const FingerAxis& axis, double last_v, double scale) {
  sum_sides(edges, axis, last_v);
  const double first_v = axis.border_v_px() - in_front_px * scale;
  const double step = step_px * scale;
  boost::container::static_vector<TipGuess, most_guesses + 1> coarse;
  for (double tip_v = first_v; tip_v < last_v; tip_v += 2 * step)
    keep_strongest(coarse, best_at(edges, axis, tip_v, {first_widths, leans, 2}), apart_px * scale);
  Guesses guesses;
  for (const TipGuess& guess : coarse) {
    for (const double tip_v : {guess.tip_v - step, guess.tip_v, guess.tip_v + step}) {
      if (tip_v < last_v) keep_strongest(guesses, best_at(edges, axis, tip_v, {widths, leans, 1}), apart_px * scale);
    }
  }
  std::sort(guesses.begin(), guesses.end(), [](const auto& x, const auto& y) { return x.strength > y.strength; });
  return guesses;
}

}  // namespace telehug
