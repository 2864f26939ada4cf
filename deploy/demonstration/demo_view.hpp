// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "demo_record.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

// The live picture: the grid of boxes with the touched one, the wearer with the motors that run. Drawn in place on a
// terminal; elsewhere a line for each thing that happens.
class DemoView {
 public:
  DemoView(const JacketProfile& profile, bool in_place);
  ~DemoView();  // leaves the cursor below
  DemoView(const DemoView&) = delete;
  DemoView& operator=(const DemoView&) = delete;

  // An event of a daemon's `watch`.
  void show(const nlohmann::json& event);

 private:
  void say(const std::string& line);
  void draw();

  const JacketProfile& profile_;
  bool in_place_;
  bool drawn_ = false;
  int touched_box_ = 0;
  int rows_ = 4;
  std::vector<std::uint8_t> running_;
  std::string last_touch_;
  std::string last_felt_;
};

}  // namespace telehug
