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
constexpr int long_from = 3;        // lengths from here on are rare,
constexpr double rare_cost = 0.06;  // and need that much more evidence
constexpr int outline_points = 25;
constexpr std::array<double, 3> leans{-0.4, 0, 0.4};  // of the tip against the finger
constexpr std::array<double, 2> widths{1.0, 0.88};    // of the tip against the finger
constexpr double sides_weight = 0.4;                  // the straight finger behind the tip must have sides,
constexpr double beyond_weight = 0.35;                // and none beyond it
constexpr double in_front_px = 24;  // of the border: a touch at the screen's edge, seen by its whole tip
constexpr double step_px = 3;
constexpr double apart_px = 10;

float side_strength(const EdgeMap& edges, const FingerAxis& axis, double v) {
  const auto u = static_cast<float>(axis.centre_u(v));
  const auto a = static_cast<float>(axis.half_width(v));
  const auto slope = static_cast<float>(axis.slope());
  const auto row = static_cast<float>(v);
  return edges.strength(u - a, row, 1, -slope) + edges.strength(u + a, row, 1, -slope);
}

// Mean strength of both sides over 2 half widths behind the tip's root.
double sides_behind(const EdgeMap& edges, const FingerAxis& axis, double root_v, double a) {
  constexpr int n = 10;
  float sum = 0;
  for (int i = 0; i < n; ++i)
    sum += side_strength(edges, axis, root_v - (0.1 + 0.2 * i) * a);
  return static_cast<double>(sum) / (2 * n);
}

// Likewise over the half width beyond the tip, where an edge may be two pixels off.
double sides_beyond(const EdgeMap& edges, const FingerAxis& axis, double tip_v, double a) {
  constexpr int n = 6;
  const auto slope = static_cast<float>(axis.slope());
  float sum = 0;
  for (int i = 0; i < n; ++i) {
    const double v = tip_v + (0.1 + 0.15 * i) * a;
    for (const double side : {-a, a}) {
      const auto u = static_cast<float>(axis.centre_u(v) + side);
      const auto row = static_cast<float>(v);
      sum += std::max({edges.strength(u - 2, row, 1, -slope), edges.strength(u, row, 1, -slope),
                       edges.strength(u + 2, row, 1, -slope)});
    }
  }
  return static_cast<double>(sum) / (2 * n);
}

}  // namespace

TipSearch::TipSearch() {
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
      outline.points.push_back({p[0], p[1], nx / norm, ny / norm});
    }
    outlines_.push_back(std::move(outline));
  }
}

TipGuess TipSearch::best_at(const EdgeMap& edges, const FingerAxis& axis, double tip_v) const {
  TipGuess best;
  best.strength = -1;
  for (std::size_t k = 0; k < outlines_.size(); ++k) {
    const Outline& outline = outlines_[k];
    const double a = axis.half_width(tip_v - outline.length * axis.half_width(tip_v));
    const double behind = sides_behind(edges, axis, tip_v - outline.length * a, a);
    const double beyond = sides_beyond(edges, axis, tip_v, a);
    const double rare = k >= long_from ? rare_cost : 0;
    const double rest = sides_weight * behind - beyond_weight * beyond - rare;
    for (const double width : widths) {
      const double half_width = width * a;
      const double root_v = tip_v - outline.length * half_width;
      const double root_u = axis.centre_u(root_v);
      for (const double extra_lean : leans) {
        const double lean = axis.slope() + extra_lean;
        float sum = 0;
        for (const OutlinePoint& p : outline.points) {
          const double along = p.y * half_width;
          sum += edges.strength(static_cast<float>(root_u + p.x * half_width + lean * along),
                                static_cast<float>(root_v + along), static_cast<float>(p.nx), static_cast<float>(p.ny));
        }
        const double strength = static_cast<double>(sum) / outline_points + rest;
        if (strength > best.strength) best = {tip_v, root_u, root_v, a, lean, strength};
      }
    }
  }
  return best;
}

TipSearch::Guesses TipSearch::find(const EdgeMap& edges, const FingerAxis& axis, double last_v, double scale) const {
  Guesses guesses;
  for (double tip_v = axis.border_v_px() - in_front_px * scale; tip_v < last_v; tip_v += step_px * scale) {
    const TipGuess guess = best_at(edges, axis, tip_v);
    // The strongest of those that are close together stays.
    const auto close = std::find_if(guesses.begin(), guesses.end(), [&](const TipGuess& other) {
      return std::abs(other.tip_v - tip_v) < apart_px * scale;
    });
    if (close != guesses.end()) {
      if (guess.strength > close->strength) *close = guess;
    } else if (guesses.size() < guesses.capacity()) {
      guesses.push_back(guess);
    } else {
      const auto weakest = std::min_element(guesses.begin(), guesses.end(),
                                            [](const auto& x, const auto& y) { return x.strength < y.strength; });
      if (guess.strength > weakest->strength) *weakest = guess;
    }
  }
  std::sort(guesses.begin(), guesses.end(), [](const auto& x, const auto& y) { return x.strength > y.strength; });
  return guesses;
}

}  // namespace telehug
