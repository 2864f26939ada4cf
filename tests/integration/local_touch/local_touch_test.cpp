// SPDX-License-Identifier: Apache-2.0
#include "local_touch/local_touch.hpp"

#include <gtest/gtest.h>

#include <future>

namespace telehug {
namespace {

constexpr ScreenSize screen{400, 300, 0, 0};

// Hangs in open() until it is let go, as a name server that does not answer would let it.
class HangingOutput final : public LocalTouchOutput {
 public:
  HangingOutput(std::promise<void>& reached, std::future<void> go_on) : reached_(reached), go_on_(std::move(go_on)) {}
  Status open(const ScreenSize& /*size*/) override {
    reached_.set_value();
    go_on_.wait();
    return Done{};
  }
  Status send(const ContactStates& /*contacts*/, Timestamp /*time*/) override { return Done{}; }
  void close() override {}
  [[nodiscard]] std::string name() const override { return "hanging"; }

 private:
  std::promise<void>& reached_;
  std::future<void> go_on_;
};

TEST(LocalTouch, NeverHoldsUpWhoTouches) {
  const SteadyClock clock;
  std::promise<void> reached;
  std::promise<void> go_on;
  std::vector<std::unique_ptr<LocalTouchOutput>> outputs;
  outputs.push_back(std::make_unique<HangingOutput>(reached, go_on.get_future()));
  LocalTouch local(std::move(outputs), clock);
  EXPECT_TRUE(local.on());
  local.put({}, screen, clock.now());
  reached.get_future().wait();
  for (int i = 0; i < 10000; ++i)
    local.put({}, screen, clock.now());  // would never return if it waited for the output
  EXPECT_EQ(local.states().at(0).name, "hanging");
  go_on.set_value();
}

TEST(LocalTouch, IsOffWithoutOutputs) {
  const SteadyClock clock;
  LocalTouch local({}, clock);
  EXPECT_FALSE(local.on());
  local.put({}, screen, clock.now());
  EXPECT_TRUE(local.states().empty());
}

}  // namespace
}  // namespace telehug
