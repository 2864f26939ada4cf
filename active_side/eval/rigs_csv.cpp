// SPDX-License-Identifier: Apache-2.0
#include "eval/rigs_csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

namespace telehug {
namespace {

std::string place_cells(const std::optional<ScreenPoint>& place) {
  return place ? fmt::format("{:.2f},{:.2f}", place->x_mm, place->y_mm) : std::string(",");
}

struct Row {
  const char* what = "";
  std::string frame;
  std::string tone = {};
  std::string screen = {};
  std::string notes = {};
  std::optional<double> hover_mm = {};
  std::optional<ScreenPoint> place = {};
  std::optional<ScreenPoint> found = {};
};

std::vector<Row> rows_of(const AlgorithmOutcome& outcome) {
  if (!outcome.failure.empty()) return {{"failed", ""}};
  std::vector<Row> rows;
  for (const ScoredTouch& touch : outcome.score.touches) {
    const auto found = touch.found ? std::optional(touch.found_place()) : std::nullopt;
    rows.push_back({touch.found ? "touch" : "missed", touch.frame, touch.tone, touch.screen, touch.notes, std::nullopt,
                    touch.place, found});
  }
  for (const ScoredRest& rest : outcome.score.rests) {
    Row row{"rest", rest.frame, rest.tone, rest.screen, rest.notes, rest.hover_mm};
    if (rest.false_touches.empty()) rows.push_back(row);
    row.what = "false";
    for (const ScreenPoint& point : rest.false_touches) {
      row.found = point;
      rows.push_back(row);
    }
  }
  for (const ExtraTouch& extra : outcome.score.extras)
    rows.push_back({"extra", extra.frame, {}, {}, {}, {}, {}, extra.place});
  return rows;
}

}  // namespace

Status write_rigs_csv(const std::filesystem::path& path, const EvalRigsOptions& options,
                      const std::vector<RigOutcome>& outcomes) {
  std::ofstream out(path);
  out << "seed,detector,model,groups,what,frame,tone,screen,notes,hover_mm,x_mm,y_mm,found_x_mm,found_y_mm\n";
  for (const RigOutcome& rig : outcomes) {
    for (std::size_t i = 0; i < rig.algorithms.size(); ++i) {
      const EvalAlgorithm& algorithm = options.rig.algorithms.at(i);
      for (const Row& row : rows_of(rig.algorithms[i])) {
        out << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", rig.seed, algorithm.detector, algorithm.model,
                           fmt::join(rig.groups, ";"), row.what, row.frame, row.tone, row.screen, row.notes,
                           row.hover_mm ? fmt::format("{:.1f}", *row.hover_mm) : std::string(), place_cells(row.place),
                           place_cells(row.found));
      }
    }
  }
  out.close();
  if (out) return Done{};
  return Error{fmt::format("can't write {}: {}", path.string(), std::generic_category().message(errno))};
}

}  // namespace telehug
