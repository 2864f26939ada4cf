// SPDX-License-Identifier: Apache-2.0
#include "integration/web/served_page.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST_F(TheWebServer, ServesThePageToWhoCameByTheLink) {
  serve();
  const std::string answer = ask(get("/"));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\n\r\n<p>page"));
  EXPECT_THAT(answer, HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self';"));
  EXPECT_THAT(answer, HasSubstr("X-Content-Type-Options: nosniff\r\n"));
  EXPECT_THAT(answer, HasSubstr("Referrer-Policy: same-origin\r\n"));
  EXPECT_THAT(answer, HasSubstr("Cache-Control: no-cache\r\n"));
}

TEST_F(TheWebServer, ListensOnLoopbackAlone) {
  serve();
  std::ifstream table("/proc/net/tcp");
  const std::string own = fmt::format("0100007F:{:04X} 00000000:0000 0A", server->port());
  const std::string any = fmt::format(":{:04X} 00000000:0000 0A", server->port());
  int listeners = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.find(any) == std::string::npos) continue;
    ++listeners;
    EXPECT_THAT(line, HasSubstr(own));
  }
  EXPECT_EQ(listeners, 1);
}

TEST_F(TheWebServer, RefusesWhatComesFromElsewhereAndWhoHasNoCookie) {
  serve();
  const auto without_host = [this](const std::string& lines) { return "GET / HTTP/1.1\r\n" + lines + cookie + "\r\n"; };
  EXPECT_THAT(ask(without_host("Host: evil.example\r\n")), StartsWith("HTTP/1.1 421 "));
  EXPECT_THAT(ask(without_host("")), StartsWith("HTTP/1.1 421 "));
  EXPECT_THAT(ask(without_host("Host: " + host() + "\r\nHost: evil.example\r\n")), StartsWith("HTTP/1.1 421 "));
  EXPECT_THAT(ask(get("/", "Origin: http://evil.example\r\n")), StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(ask(get("/", "Origin: http://" + host() + "\r\nOrigin: http://evil.example\r\n")),
              StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(ask("GET / HTTP/1.1\r\nHost: " + host() + "\r\n\r\n"), StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(
      ask("GET / HTTP/1.1\r\nHost: " + host() + "\r\nCookie: telehug-test=" + std::string(64, 'a') + "\r\n\r\n"),
      StartsWith("HTTP/1.1 401 "));
  EXPECT_EQ(server->stats().refused_requests, 7U);
}

TEST_F(TheWebServer, HasNoFileSystem) {
  serve();
  for (const char* path : {"/../../../../etc/passwd", "/..%2f..%2fetc/passwd", "//etc/passwd", "/./index.html",
                           "/shared/../index.html", "/proc/self/environ"}) {
    EXPECT_THAT(ask(get(path)), AllOf(StartsWith("HTTP/1.1 404 "), Not(HasSubstr("root:")))) << path;
  }
}

TEST_F(TheWebServer, PassesCommandsOnAndAnswersSeveralRequestsOnAConnection) {
  serve();
  RawBrowser browser(server->port());
  browser.send(post(R"({"command":"echo","say":1})") + get("/") + post(R"({"command":"echo","say":2})"));
  EXPECT_THAT(browser.read_answer(), HasSubstr(R"({"command":"echo","say":1})"));
  EXPECT_THAT(browser.read_answer(), HasSubstr("<p>page"));
  EXPECT_THAT(browser.read_answer(), HasSubstr(R"({"command":"echo","say":2})"));
  EXPECT_EQ(asked, 2);
}

TEST_F(TheWebServer, LetsNoOtherPageSendACommand) {
  serve();
  std::string foreign = post(R"({"command":"echo"})");
  foreign.replace(foreign.find("Origin: http://127"), 18, "Origin: http://evl");
  EXPECT_THAT(ask(foreign), StartsWith("HTTP/1.1 403 "));
  EXPECT_EQ(asked, 0);
}

TEST_F(TheWebServer, RefusesWhatIsTooLongWithoutReadingIt) {
  serve();
  const double before_mb = resident_mb();
  std::string request = post("");
  request.replace(request.find("Content-Length: 0"), 17, "Content-Length: 10000000");
  const std::string part(1'000'000, ' ');
  for (int i = 0; i < 20; ++i) {
    RawBrowser browser(server->port());
    browser.send(request);
    // It is closed meanwhile, and may be so by a reset, which takes the answer with it.
    for (int sent = 0; sent < 10 && browser.send(part); ++sent) {
    }
    EXPECT_THAT(browser.read_to_the_end(), AnyOf(StartsWith("HTTP/1.1 413 "), IsEmpty()));
  }
  std::string chunked = post("");
  chunked.replace(chunked.find("Content-Length: 0"), 17, "Transfer-Encoding: chunked");
  RawBrowser browser(server->port());
  browser.send(chunked + "989680\r\n");
  (void)browser.send(part);
  EXPECT_THAT(browser.read_to_the_end(), AnyOf(StartsWith("HTTP/1.1 413 "), IsEmpty()));
  EXPECT_THAT(ask(get("/", "X: " + std::string(10'000, 'x') + "\r\n")), AnyOf(StartsWith("HTTP/1.1 431 "), IsEmpty()));
  EXPECT_LT(resident_mb() - before_mb, 40);
  EXPECT_EQ(asked, 0);
  EXPECT_THAT(ask(get("/")), StartsWith("HTTP/1.1 200 "));
}

TEST_F(TheWebServer, RefusesWhatIsNoHttp) {
  serve();
  EXPECT_THAT(ask("hello\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(ask(std::string(100, '\0') + "\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
}

TEST_F(TheWebServer, KeepsServingItsPageWhileOthersHoldFiveHundredSlowConnections) {
  serve();
  RawBrowser page(server->port());
  page.send(get("/"));
  EXPECT_THAT(page.read_answer(), HasSubstr("<p>page"));
  std::vector<RawBrowser> slow;
  for (int i = 0; i < 500; ++i) {
    slow.emplace_back(server->port());
    (void)slow.back().send("GET / HTTP/1.1\r\nHo");
  }
  EXPECT_TRUE(eventually([this] { return server->stats().refused_connections + options.most_connections >= 500; }));
  EXPECT_LE(server->stats().connections, options.most_connections);
  page.send(get("/"));
  EXPECT_THAT(page.read_answer(), HasSubstr("<p>page")) << "the one that was there";
  EXPECT_THAT(ask(get("/")), HasSubstr("<p>page")) << "and a new one";
}

TEST_F(TheWebServer, TurnsANewConnectionAwayWhileAllBelongToPages) {
  options.most_connections = 2;
  serve();
  std::vector<RawBrowser> pages;
  for (int i = 0; i < 2; ++i) {
    pages.emplace_back(server->port()).send(get("/"));
    EXPECT_THAT(pages.back().read_answer(), HasSubstr("<p>page"));
  }
  RawBrowser newcomer(server->port());
  (void)newcomer.send(get("/"));
  EXPECT_THAT(newcomer.read_to_the_end(), IsEmpty());
  EXPECT_EQ(server->stats().refused_connections, 1U);
  pages.front().send(get("/"));
  EXPECT_THAT(pages.front().read_answer(), HasSubstr("<p>page"));
}

// Each with the one limit that it is about: what is not to be late may be as slow as it likes.

TEST_F(TheWebServer, ClosesAStrangersConnectionThatBringsNoRequestInTime) {
  options.stranger_timeout = 20ms;
  begin();
  RawBrowser says_nothing(server->port());
  EXPECT_THAT(says_nothing.read_to_the_end(), IsEmpty());
  RawBrowser says_half(server->port());
  (void)says_half.send("GET / HT");
  EXPECT_THAT(says_half.read_to_the_end(), IsEmpty());
  EXPECT_TRUE(eventually([this] { return server->stats().connections == 0; }));
}

TEST_F(TheWebServer, ClosesAPagesConnectionThatBringsHalfARequestAndNoMore) {
  options.request_timeout = 20ms;
  serve();
  RawBrowser page(server->port());
  page.send(get("/") + "GET / HT");
  EXPECT_THAT(page.read_answer(), HasSubstr("<p>page"));
  EXPECT_THAT(page.read_to_the_end(), IsEmpty());
}

TEST_F(TheWebServer, ClosesAPagesConnectionThatIsNotUsed) {
  options.idle_timeout = 20ms;
  serve();
  RawBrowser page(server->port());
  page.send(get("/"));
  EXPECT_THAT(page.read_to_the_end(), HasSubstr("<p>page"));
}

TEST_F(TheWebServer, ClosesAConnectionWhoseCommandTheDaemonDoesNotAnswer) {
  options.answer_timeout = 20ms;
  serve();
  RawBrowser page(server->port());
  page.send(post(R"({"command":"silence"})"));
  EXPECT_THAT(page.read_to_the_end(), IsEmpty());
  EXPECT_EQ(asked, 1);
}

TEST_F(TheWebServer, EndsWithConnectionsOpenAndCommandsUnanswered) {
  serve();
  RawBrowser follower(server->port());
  follower.send(get("/live?topics=news"));
  RawBrowser waiting(server->port());
  waiting.send(post(R"({"command":"silence"})"));
  RawBrowser half(server->port());
  half.send("GET ");
  EXPECT_TRUE(eventually([this] { return server->stats().streams == 1 && asked == 1; }));
  server.reset();
  EXPECT_THAT(follower.read_to_the_end(), HasSubstr("text/event-stream"));
  EXPECT_THAT(waiting.read_to_the_end(), IsEmpty());
}

TEST_F(TheWebServer, SaysWhichPortItCanNotHave) {
  serve();
  options.port = server->port();
  try {
    WebServer second(options, {}, WebFiles({served_files}), {}, clock);
    FAIL() << "two can't have one port";
  } catch (const std::runtime_error& problem) {
    EXPECT_THAT(problem.what(), HasSubstr(fmt::format("on port {}: ", options.port)));
  }
}

}  // namespace
}  // namespace telehug
