// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "doubles/socket_pair.hpp"
#include "wire/wire_opener.hpp"

namespace telehug {

// The other end of wires that a ScriptedOpener opens. Outlives the link.
struct FarEnd {
  enum class Answer { wire, error, later };
  Answer answer = Answer::wire;
  std::vector<Timestamp> asked;
  std::unique_ptr<SocketPair> wire;  // the newest
};

// Opens what the test says.
class ScriptedOpener final : public WireOpener {
 public:
  explicit ScriptedOpener(FarEnd& far) : far_(far) {}

  std::optional<Result<Wire>> open(Timestamp now) override {
    far_.asked.push_back(now);
    if (far_.answer == FarEnd::Answer::later) return std::nullopt;
    if (far_.answer == FarEnd::Answer::error) return Error{"there is none; make one"};
    far_.wire = std::make_unique<SocketPair>();
    return Wire(far_.wire->give());
  }
  const std::string& device() const override { return device_; }
  const std::string& progress() const override { return progress_; }
  const std::string& lost_advice() const override { return lost_advice_; }

 private:
  FarEnd& far_;
  std::string device_ = "far end";
  std::string progress_ = "getting there";
  std::string lost_advice_ = "mend it";
};

}  // namespace telehug
