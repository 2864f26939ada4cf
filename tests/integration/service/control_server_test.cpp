// SPDX-License-Identifier: Apache-2.0
#include "service/control_server.hpp"

#include <gmock/gmock.h>

#include <future>
#include <list>
#include <random>
#include <thread>

#include "doubles/temporary_folder.hpp"
#include "integration/service/raw_connection.hpp"
#include "service/control_client.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class ControlServerTest : public testing::Test {
 protected:
  ControlServerTest() { options_.socket = folder_.path() / "test.sock"; }

  ControlServer& serve() {
    server_.emplace(options_);
    server_->on("status", [](const Json&) -> Json { return {{"side", "active"}}; });
    server_->on("echo", [](const Json& request) -> Json { return {{"said", request.at("say")}}; });
    server_->on("who", [](const Json&, const Caller& caller) -> Json {
      return {{"pid", caller.pid}, {"uid", caller.uid}, {"gid", caller.gid}};
    });
    server_->start();
    return *server_;
  }

  Json ask(const Json& request) {
    auto client = ControlClient::connect(options_.socket);
    if (!std::holds_alternative<ControlClient>(client)) return "no connection";
    auto reply = std::get<ControlClient>(client).ask(request, 20s);
    return reply ? *reply : Json(reply.error().message);
  }

  TemporaryFolder folder_;
  ControlServerOptions options_;
  std::optional<ControlServer> server_;
};

TEST_F(ControlServerTest, AnswersACommandWithWhatItsHandlerReturns) {
  serve();
  EXPECT_EQ(ask({{"command", "status"}}), Json({{"side", "active"}}));
  EXPECT_EQ(ask({{"command", "echo"}, {"say", {1, 2}}}), Json({{"said", {1, 2}}}));
}

TEST_F(ControlServerTest, AnswersSeveralRequestsOnOneConnectionInOrder) {
  serve();
  RawConnection connection(options_.socket);
  connection.send("{\"command\":\"echo\",\"say\":1}\n{\"command\":\"echo\",\"say\":2}\n{\"command\":\"ec");
  EXPECT_EQ(connection.line(), "{\"said\":1}");
  EXPECT_EQ(connection.line(), "{\"said\":2}");
  connection.send("ho\",\"say\":3}\n");
  EXPECT_EQ(connection.line(), "{\"said\":3}");
}

TEST_F(ControlServerTest, TellsHandlersWhoAsks) {
  serve();
  const Json who = ask({{"command", "who"}});
  EXPECT_EQ(who["pid"], getpid());
  EXPECT_EQ(who["uid"], geteuid());
  EXPECT_EQ(who["gid"], getegid());
}

TEST_F(ControlServerTest, AnswersARequestOfItsOwnProgramAsOneOfTheSocket) {
  ControlServer& server = serve();
  const auto answer_to = [&server](const Json& request) {
    std::promise<Json> answer;
    server.ask(request, [&answer](Json said) { answer.set_value(std::move(said)); });
    auto said = answer.get_future();
    return said.wait_for(20s) == std::future_status::ready ? said.get() : Json("no answer");
  };
  EXPECT_EQ(answer_to({{"command", "echo"}, {"say", 7}}), Json({{"said", 7}}));
  EXPECT_EQ(answer_to({{"command", "who"}}).at("pid"), getpid());
  EXPECT_TRUE(answer_to({{"command", "echo"}}).contains("error")) << "its handler throws";
  EXPECT_TRUE(answer_to({{"command", "watch"}}).contains("error")) << "there is nobody to tell";
  EXPECT_EQ(server.stats().requests, 4U);
}

TEST_F(ControlServerTest, SaysWhatItKnowsWhenACommandIsUnknown) {
  serve();
  EXPECT_EQ(ask({{"command", "dance"}}),
            Json({{"error", "unknown command \"dance\"; known are watch, echo, status, who"}}));
}

TEST_F(ControlServerTest, TurnsAHandlersExceptionIntoAnErrorAndLivesOn) {
  serve();
  EXPECT_TRUE(ask({{"command", "echo"}}).contains("error"));
  EXPECT_EQ(ask({{"command", "status"}}), Json({{"side", "active"}}));
}

TEST_F(ControlServerTest, RefusesGarbageLineByLineOnTheSameConnection) {
  const ControlServer& server = serve();
  RawConnection connection(options_.socket);
  for (const char* garbage : {"", "hello", "[]", "5", "{\"command\":5}", "{\"command\"", "\xff\xfe", "null"}) {
    connection.send(std::string(garbage) + "\n");
    EXPECT_THAT(connection.line().value_or("closed"), HasSubstr("a request is a line of JSON")) << garbage;
  }
  connection.send("{\"command\":\"status\"}\n");
  EXPECT_EQ(connection.line(), "{\"side\":\"active\"}");
  EXPECT_EQ(server.stats().malformed_requests, 8U);
}

TEST_F(ControlServerTest, SurvivesRandomBytes) {
  serve();
  std::mt19937 random(4);
  for (int round = 0; round < 30; ++round) {
    RawConnection connection(options_.socket);
    std::string bytes(random() % 20'000, '\0');
    for (char& c : bytes)
      c = static_cast<char>(random());
    connection.send(bytes);
  }
  EXPECT_EQ(ask({{"command", "status"}}), Json({{"side", "active"}}));
}

TEST_F(ControlServerTest, SurvivesADeeplyNestedRequest) {
  serve();
  RawConnection connection(options_.socket);
  connection.send(std::string(60'000, '[') + "\n");
  EXPECT_THAT(connection.line().value_or("closed"), HasSubstr("error"));
}

TEST_F(ControlServerTest, EndsAConnectionThatSendsAnEndlessLine) {
  serve();
  RawConnection connection(options_.socket);
  const std::string block(4096, 'x');
  int sent = 0;
  while (sent < 1000 && connection.send(block))
    ++sent;
  EXPECT_LT(sent, 1000) << "the server took 4 MB of one line";
  EXPECT_EQ(connection.line(), "{\"error\":\"the request is too long\"}");
  EXPECT_TRUE(connection.closed());
}

TEST_F(ControlServerTest, TakesALineOfTheLongestLengthAndNoLonger) {
  serve();
  const std::string frame = "{\"command\":\"echo\",\"say\":\"\"}";
  const std::string fits(options_.most_request_bytes - frame.size(), 'a');
  EXPECT_EQ(ask({{"command", "echo"}, {"say", fits}})["said"], fits);
  EXPECT_EQ(ask({{"command", "echo"}, {"say", fits + "a"}})["error"], "the request is too long");
}

TEST_F(ControlServerTest, EndsAConnectionThatNeverFinishesARequest) {
  options_.half_request_timeout = 50ms;
  serve();
  RawConnection connection(options_.socket);
  connection.send("{\"comm");
  EXPECT_TRUE(connection.closed());
}

TEST_F(ControlServerTest, GivesNoMoreTimeForARequestThatDripsIn) {
  options_.half_request_timeout = 100ms;
  serve();
  RawConnection connection(options_.socket);
  // Each byte comes well within the time; all of them together do not.
  int bytes = 0;
  while (bytes < 2000 && connection.send("x")) {
    ++bytes;
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_LT(bytes, 2000);
}

TEST_F(ControlServerTest, EndsAConnectionThatAsksNothing) {
  options_.idle_timeout = 50ms;
  serve();
  RawConnection connection(options_.socket);
  EXPECT_TRUE(connection.closed());
}

TEST_F(ControlServerTest, AnswersSixteenOfAHundredClientsAndTellsTheOthersWhy) {
  const ControlServer& server = serve();
  std::list<RawConnection> connections;
  std::size_t answered = 0;
  std::size_t refused = 0;
  for (int i = 0; i < 100; ++i) {
    auto& connection = connections.emplace_back(options_.socket);
    connection.send("{\"command\":\"status\"}\n");
    const std::string reply = connection.line().value_or("closed");
    if (reply == "{\"side\":\"active\"}") ++answered;
    if (reply.find("too many connections") != std::string::npos) ++refused;
  }
  EXPECT_EQ(answered, 16U);
  EXPECT_EQ(refused, 84U);
  EXPECT_EQ(server.stats().clients, 16U);
  connections.clear();
  // The places are free again as soon as the server has seen the connections close.
  Json reply;
  for (int attempt = 0; attempt < 1000 && reply != Json({{"side", "active"}}); ++attempt) {
    reply = ask({{"command", "status"}});
  }
  EXPECT_EQ(reply, Json({{"side", "active"}}));
}

TEST_F(ControlServerTest, AnswersManyClientsAtOnce) {
  options_.most_clients = 100;
  serve();
  std::vector<std::thread> threads;
  std::atomic<int> right{0};
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([this, t, &right] {
      for (int i = 0; i < 50; ++i) {
        if (ask({{"command", "echo"}, {"say", t * 100 + i}}) == Json({{"said", t * 100 + i}})) ++right;
      }
    });
  }
  for (auto& thread : threads)
    thread.join();
  EXPECT_EQ(right, 400);
}

TEST_F(ControlServerTest, ReplacesBytesThatAreNotUtf8) {
  serve();
  server_.reset();
  server_.emplace(options_);
  server_->on("name", [](const Json&) -> Json { return {{"name", "C\xff"}}; });
  server_->start();
  EXPECT_EQ(ask({{"command", "name"}})["name"], "C\xef\xbf\xbd");
}

TEST_F(ControlServerTest, GoesAwayWhileClientsAreConnected) {
  serve();
  RawConnection idle(options_.socket);
  RawConnection half(options_.socket);
  half.send("{\"comm");
  EXPECT_EQ(ask({{"command", "status"}}), Json({{"side", "active"}}));
  server_.reset();
  EXPECT_TRUE(idle.closed());
  EXPECT_TRUE(half.closed());
  EXPECT_FALSE(std::filesystem::exists(options_.socket));
}

}  // namespace
}  // namespace telehug
