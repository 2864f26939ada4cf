// SPDX-License-Identifier: Apache-2.0
//
// With a shell in the place of `telehug pair`; tests/ui makes pairs by the real one.
#include "daemon/pairing_run.hpp"

#include <gtest/gtest.h>

#include <future>

namespace telehug {
namespace {

using Json = nlohmann::json;

class ShellRun {
 public:
  explicit ShellRun(const std::string& script) : ShellRun(std::vector<std::string>{"/bin/sh", "-c", script}) {}
  explicit ShellRun(std::vector<std::string> command)
      : run_(std::move(command), {[this](const Json& object) {
                                    if (objects_.empty()) first_.set_value();
                                    objects_.push_back(object);
                                  },
                                  [this](const std::string& problem) { end_.set_value(problem); }}) {}

  void wait_for_an_object() { first_.get_future().wait(); }
  std::string end() { return end_.get_future().get(); }
  [[nodiscard]] const std::vector<Json>& objects() const { return objects_; }
  void cancel() { run_.cancel(); }

 private:
  std::vector<Json> objects_;
  std::promise<void> first_;
  std::promise<std::string> end_;
  PairingRun run_;
};

TEST(APairingRun, TellsEachObjectThatTheProgramPrints) {
  ShellRun run(R"(echo '{"code": "A"}'; echo '{"pair": {"id": "1"}}')");
  EXPECT_EQ(run.end(), "");
  EXPECT_EQ(run.objects(), (std::vector<Json>{{{"code", "A"}}, {{"pair", {{"id", "1"}}}}}));
}

TEST(APairingRun, SaysWhyItFailedAsTheProgramDid) {
  ShellRun run("echo 'telehug: the code is over' >&2; exit 9");
  EXPECT_EQ(run.end(), "the code is over");
  EXPECT_TRUE(run.objects().empty());
}

TEST(APairingRun, SaysThatItFailedEvenIfTheProgramSaysNothing) {
  EXPECT_EQ(ShellRun("exit 1").end(), "the pairing broke off");
}

TEST(APairingRun, EndsWhenItIsCancelled) {
  ShellRun run("echo '{}'; exec sleep 100");
  run.wait_for_an_object();
  run.cancel();
  EXPECT_EQ(run.end(), "the pairing broke off");
}

TEST(APairingRun, SaysWhichProgramIsMissing) {
  EXPECT_EQ(ShellRun(std::vector<std::string>{"/nowhere/telehug", "pair"}).end(),
            "can't run /nowhere/telehug: No such file or directory");
}

TEST(APairingRun, DoesNotReadALineWithoutEnd) {
  EXPECT_NE(ShellRun("exec cat /dev/zero").end(), "");
}

}  // namespace
}  // namespace telehug
