// SPDX-License-Identifier: Apache-2.0
//
// Two PCs in two homes become a pair by `telehug pair` as people use it, and touch each other then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <system_error>

#include "doubles/child_program.hpp"
#include "integration/link_faults/faulty_link.hpp"
#include "pairing_link/pairing_code.hpp"
#include "service/control_socket.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* telehug_program = TELEHUG_BIN "/telehug";

// What follows `label` on the line that begins with it.
std::string after(const std::string& label, const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(label)) return line.substr(label.size());
  return "";
}

class PairingBetweenHomes : public testing::Test {
 protected:
  void SetUp() override {
    try {
      link = std::make_unique<FaultyLink>(FaultyLink::Pairing::left_to_the_test);
    } catch (const std::system_error& error) {
      GTEST_SKIP() << "network namespaces are not permitted here: " << error.what();
    }
  }

  static Side side_of(Home home) { return home == Home::parent ? Side::active : Side::passive; }
  [[nodiscard]] std::string store_of(Home home) const {
    return link->pair.folder / ("pairs-" + side_name(side_of(home)));
  }
  [[nodiscard]] std::vector<std::string> command(Home home, std::vector<std::string> words) const {
    words.insert(words.begin(), {telehug_program, "pair"});
    words.insert(words.end(), {"--side", side_name(side_of(home)), "--folder", store_of(home)});
    return words;
  }
  [[nodiscard]] Outcome pair(Home home, std::vector<std::string> words) const {
    return link->run(home, command(home, std::move(words)));
  }
  [[nodiscard]] std::string list(Home home) const { return pair(home, {"list"}).text; }

  // `telehug pair invite` in the child's home; its first line is the code.
  [[nodiscard]] std::unique_ptr<ChildProgram> invite() const {
    const InsideNamespace inside(link->homes.network(Home::child));
    return std::make_unique<ChildProgram>(
        command(Home::child, {"invite", "--name", "Kim", "--address", TwoHomes::address(Home::child)}));
  }
  static std::string all_lines(const ChildProgram& program) {
    std::string text;
    for (std::string line = program.read_line(); !line.empty(); line = program.read_line())
      text += line + "\n";
    return text;
  }

  // By connection. The phrase that both programs printed.
  std::string pair_up() const {
    const auto inviter = invite();
    const std::string code = inviter->read_line();
    const Outcome accepted = pair(Home::parent, {"accept", code, "--name", "Mum"});
    EXPECT_EQ(accepted.code, 0) << accepted.text;
    const std::string invited = all_lines(*inviter);
    EXPECT_EQ(inviter->wait_for_end(), 0);
    EXPECT_THAT(invited, HasSubstr("Paired with Mum")) << invited;
    EXPECT_THAT(accepted.text, HasSubstr("Paired with Kim"));
    EXPECT_EQ(after("Phrase: ", invited), after("Phrase: ", accepted.text));
    return after("Phrase: ", accepted.text);
  }

  [[nodiscard]] bool last_touch_was_driven() const {
    return eventually([&] { return link->pair.status(Side::passive)["last_touch"]["outcome"] == "driven"; });
  }
  void expect_touches_flow() const {
    ASSERT_TRUE(link->start_all()) << link->pair.logs();
    EXPECT_TRUE(eventually([&] {
      return link->pair.status(Side::active)["state"] == "ok" && link->pair.status(Side::passive)["state"] == "ok";
    })) << link->pair.logs();
    EXPECT_TRUE(last_touch_was_driven()) << link->pair.logs();
  }

  std::unique_ptr<FaultyLink> link;
};

TEST_F(PairingBetweenHomes, ByACodeLetsTouchesFlowUntilThePairIsRevoked) {
  const std::string phrase = pair_up();
  EXPECT_EQ(std::count(phrase.begin(), phrase.end(), ' '), 7) << phrase;
  EXPECT_THAT(list(Home::parent), AllOf(HasSubstr("Kim"), HasSubstr(phrase)));
  EXPECT_THAT(list(Home::child), AllOf(HasSubstr("Mum"), HasSubstr(phrase)));

  link->pair.camera = "virtual";  // its hands move, so that there is something to watch
  link->pair.start_jacket();
  link->start_passive();
  link->pair.calibrate("virtual");
  link->start_active();
  ASSERT_TRUE(eventually([&] { return link->pair.felt(); }, 60s)) << link->pair.logs();
  EXPECT_EQ(link->pair.status(Side::active)["pair"]["phrase"], phrase);
  EXPECT_EQ(link->pair.status(Side::passive)["pair"]["phrase"], phrase);
  EXPECT_TRUE(last_touch_was_driven()) << link->pair.logs();
  // Both sides' `telehug watch` shows a touch that was felt.
  for (const Side side : {Side::active, Side::passive}) {
    const Outcome watched =
        link->pair.run({telehug_program, "watch", "--count", "60", "--socket", link->pair.socket(side).string()});
    EXPECT_EQ(watched.code, 0) << watched.text;
    EXPECT_THAT(watched.text, AllOf(HasSubstr("felt"), HasSubstr("outcome=driven"))) << watched.text;
  }

  const std::string id = link->pair.pairs(Side::passive).list().at(0).id;
  ASSERT_TRUE(eventually([&] { return link->pair.felt(); }));
  EXPECT_EQ(pair(Home::child, {"revoke", id}).code, 0);
  EXPECT_TRUE(eventually([&] { return !link->pair.passive->runs(); })) << link->pair.logs();
  EXPECT_FALSE(link->pair.felt());
  EXPECT_EQ(link->pair.passive->end(), to_int(ExitCode::pair_ended));
  EXPECT_THAT(content_of(link->pair.folder / "passive.log"), HasSubstr("the pair with Mum was revoked on this PC"));
  EXPECT_TRUE(eventually([&] {
    return link->pair.complains(Side::active, "no peer is connected: the pair was revoked on the other PC");
  })) << link->pair.logs();
  EXPECT_TRUE(eventually([&] {
    return content_of(link->pair.folder / "active.log").find("the pair was revoked on the other PC") !=
           std::string::npos;
  })) << link->pair.logs();
  EXPECT_THAT(list(Home::child), HasSubstr("no pairs"));

  EXPECT_EQ(pair(Home::parent, {"revoke", id}).code, 0);
  EXPECT_TRUE(eventually([&] { return !link->pair.active->runs(); })) << link->pair.logs();
  EXPECT_EQ(link->pair.active->end(), to_int(ExitCode::pair_ended));
}

TEST_F(PairingBetweenHomes, ByTextsLetsTouchesFlowThoughNoPacketPassedMeanwhile) {
  const std::string request = link->pair.folder / "request.txt";
  const std::string grant = link->pair.folder / "grant.txt";
  link->homes.set_both({.loss = 1});
  const Outcome asked = pair(Home::parent, {"request", "--name", "Mum", "--file", request});
  ASSERT_EQ(asked.code, 0) << asked.text;
  std::string line;
  for (const std::string& word : command(Home::child, {"grant", "--name", "Kim", "--file", request}))
    line += word + " ";
  const Outcome granted = link->run(Home::child, {"/bin/sh", "-c", line + "> " + grant});
  ASSERT_EQ(granted.code, 0) << granted.text;
  const Outcome finished = pair(Home::parent, {"finish", "--file", grant});
  ASSERT_EQ(finished.code, 0) << finished.text;
  EXPECT_EQ(after("Phrase: ", granted.text), after("Phrase: ", finished.text));
  EXPECT_NE(after("Phrase: ", finished.text), "");
  expect_touches_flow();
}

TEST_F(PairingBetweenHomes, AWrongCodeIsRefusedAndTheRightOneStillWorksAndOnlyOnce) {
  const auto inviter = invite();
  const std::string code = inviter->read_line();
  PairingCode wrong = parse_pairing_code(code).value();
  wrong.secret.front() = static_cast<std::uint8_t>(wrong.secret.front() + 1);
  const Outcome refused = pair(Home::parent, {"accept", to_text(wrong)});
  EXPECT_EQ(refused.code, to_int(ExitCode::refused));
  EXPECT_THAT(refused.text, HasSubstr("code")) << refused.text;
  EXPECT_THAT(list(Home::parent), HasSubstr("no pairs"));

  EXPECT_EQ(pair(Home::parent, {"accept", code}).code, 0);
  EXPECT_EQ(inviter->wait_for_end(), 0);
  const Outcome again = pair(Home::parent, {"accept", code});
  EXPECT_EQ(again.code, to_int(ExitCode::refused));
  EXPECT_THAT(again.text, HasSubstr("nobody waits")) << again.text;
  EXPECT_EQ(link->pair.pairs(Side::active).list().size(), 1U);
}

TEST_F(PairingBetweenHomes, ACodeOfSomebodyWhoCantBeReachedIsNoPair) {
  const auto inviter = invite();
  const std::string code = inviter->read_line();
  link->homes.set_both({.loss = 1});
  const Outcome refused = pair(Home::parent, {"accept", code});
  EXPECT_EQ(refused.code, to_int(ExitCode::refused));
  EXPECT_THAT(refused.text, HasSubstr(TwoHomes::address(Home::child))) << refused.text;
  EXPECT_THAT(list(Home::parent), HasSubstr("no pairs"));
}

}  // namespace
}  // namespace telehug
