// SPDX-License-Identifier: Apache-2.0
#include "local_touch/local_touch_outputs.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

constexpr ScreenSize screen{400, 300, 0, 0};

// What a test sees of an output, and how it lets it fail.
struct Notes {
  bool can_open = true;
  bool can_send = true;
  int opened = 0;
  int closed = 0;
  double width_mm = 0;
  std::vector<std::size_t> sent;  // contacts that were down
};

class NotedOutput final : public LocalTouchOutput {
 public:
  explicit NotedOutput(Notes& notes) : notes_(notes) {}
  Status open(const ScreenSize& size) override {
    ++notes_.opened;
    notes_.width_mm = size.width_mm;
    if (!notes_.can_open) return Error{"no right"};
    return Done{};
  }
  Status send(const ContactStates& contacts, Timestamp /*time*/) override {
    if (!notes_.can_send) return Error{"gone"};
    notes_.sent.push_back(contacts.size());
    return Done{};
  }
  void close() override { ++notes_.closed; }
  [[nodiscard]] std::string name() const override { return "noted"; }

 private:
  Notes& notes_;
};

class LocalOutputs : public testing::Test {
 protected:
  LocalOutputs() {
    std::vector<std::unique_ptr<LocalTouchOutput>> made;
    made.push_back(std::make_unique<NotedOutput>(first_));
    made.push_back(std::make_unique<NotedOutput>(second_));
    outputs_.emplace(std::move(made));
  }
  void frame(std::size_t contacts, ScreenSize size = screen) {
    now_ += 33ms;
    LocalTouchFrame touched{{}, size, now_};
    for (std::size_t i = 0; i < contacts; ++i)
      touched.contacts.push_back({.id = static_cast<std::uint32_t>(i + 1), .screen = {}, .frame_time = {}});
    outputs_->serve(&touched, now_);
  }
  void pass(Duration time) {
    for (const Timestamp end = now_ + time; now_ < end;) {
      now_ += 100ms;
      outputs_->serve(nullptr, now_);
    }
  }

  Notes first_;
  Notes second_;
  std::optional<LocalTouchOutputs> outputs_;
  Timestamp now_{1s};
};

TEST_F(LocalOutputs, OpenWithTheFirstFrameAndGetEachOne) {
  pass(1s);
  EXPECT_EQ(first_.opened, 0) << "the screen is not known";
  frame(1);
  frame(2);
  EXPECT_EQ(first_.opened, 1);
  EXPECT_EQ(first_.sent, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(second_.sent, (std::vector<std::size_t>{1, 2}));
  EXPECT_TRUE(outputs_->states()[0].open);
}

TEST_F(LocalOutputs, GoOnWithoutTheOneThatFailsAndTryItAgain) {
  first_.can_open = false;
  frame(1);
  frame(1);
  EXPECT_EQ(first_.opened, 1);
  EXPECT_EQ(second_.sent.size(), 2U);
  EXPECT_EQ(outputs_->states()[0].problem, "no right");
  EXPECT_FALSE(outputs_->states()[0].open);
  pass(4900ms);
  EXPECT_EQ(first_.opened, 1);
  first_.can_open = true;
  pass(200ms);
  EXPECT_EQ(first_.opened, 2);
  EXPECT_TRUE(outputs_->states()[0].open);
  EXPECT_EQ(outputs_->states()[0].problem, "");
  frame(1);
  EXPECT_EQ(first_.sent.size(), 1U);
}

TEST_F(LocalOutputs, CloseWhatFailsWhileSendingAndOpenItLater) {
  frame(1);
  first_.can_send = false;
  frame(1);
  EXPECT_EQ(first_.closed, 1 + 1) << "once for the new screen, once for the failure";
  EXPECT_EQ(outputs_->states()[0].problem, "gone");
  first_.can_send = true;
  pass(5s);
  EXPECT_EQ(first_.opened, 2);
}

TEST_F(LocalOutputs, OpenAgainForAnotherScreen) {
  frame(1);
  frame(1, {500, 300, 0, 0});
  EXPECT_EQ(first_.opened, 2);
  EXPECT_EQ(first_.width_mm, 500);
}

TEST_F(LocalOutputs, LiftEverythingWhenFramesStopComing) {
  frame(2);
  pass(400ms);
  EXPECT_EQ(first_.sent.size(), 1U);
  pass(10s);
  EXPECT_EQ(first_.sent, (std::vector<std::size_t>{2, 0}));
}

}  // namespace
}  // namespace telehug
