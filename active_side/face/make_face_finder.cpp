// SPDX-License-Identifier: Apache-2.0
#include "face/make_face_finder.hpp"

#include <fmt/format.h>

#include <utility>

#include "face/haar_face_finder.hpp"

namespace telehug {

Result<ChosenFaceFinder> make_face_finder(const std::string& name,
                                          const std::vector<std::filesystem::path>& blaze_models) {
  ChosenFaceFinder chosen;
  if (name != "haar") {
    auto blaze = make_blaze_face_finder(blaze_models);
    if (blaze) return ChosenFaceFinder{*std::move(blaze), ""};
    chosen.note =
        fmt::format("{} Until then faces are looked for with Haar, which misses more of them.", blaze.error().message);
  }
  auto haar = make_haar_face_finder();
  if (!haar) return chosen.note.empty() ? haar.error() : Error{chosen.note + " " + haar.error().message};
  chosen.finder = *std::move(haar);
  return chosen;
}

}  // namespace telehug
