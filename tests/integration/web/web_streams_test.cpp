// SPDX-License-Identifier: Apache-2.0
#include "doubles/allocation_counter.hpp"
#include "integration/web/served_page.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST_F(TheWebServer, TellsAPageTheNewestAndWhatItBecomes) {
  serve();
  EXPECT_FALSE(server->has_followers());
  server->tell("news", {{"number", 1}});
  RawBrowser browser(server->port());
  browser.send(get("/live?topics=news"));
  EXPECT_THAT(browser.read_until("\r\n\r\n"), HasSubstr("Content-Type: text/event-stream\r\n"));
  EXPECT_EQ(browser.read_until("\n\n"), "event: news\ndata: {\"number\":1}\n\n");
  EXPECT_TRUE(server->has_followers());
  server->tell("news", {{"number", 2}});
  EXPECT_EQ(browser.read_until("\n\n"), "event: news\ndata: {\"number\":2}\n\n");
}

TEST_F(TheWebServer, ShowsALivePictureThatNoBrowserKeeps) {
  picture = std::make_shared<const std::string>("\xFF\xD8 a picture");
  serve();
  const std::string answer = ask(get("/picture/camera.jpg"));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(answer, HasSubstr("Content-Type: image/jpeg\r\n"));
  EXPECT_THAT(answer, HasSubstr("Cache-Control: no-store\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\n\r\n\xFF\xD8 a picture"));
}

TEST_F(TheWebServer, AnswersForAPictureThatIsNotThereAndGoesOn) {
  serve();
  RawBrowser browser(server->port());
  browser.send(get("/picture/camera.jpg") + get("/"));
  EXPECT_THAT(browser.read_answer(), StartsWith("HTTP/1.1 204 "));
  EXPECT_THAT(browser.read_answer(), HasSubstr("<p>page"));
}

TEST_F(TheWebServer, QueuesNothingForAPageThatReadsTooSlowly) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer's heap keeps what was freed";
  serve();
  RawBrowser page(server->port(), 4096);
  page.send(get("/live?topics=news"));
  EXPECT_TRUE(eventually([this] { return server->stats().streams == 1; }));
  const double before_mb = resident_mb();
  const std::string filling(500'000, 'x');
  constexpr int all = 400;
  for (int number = 1; number <= all; ++number)
    server->tell("news", {{"filling", filling}, {"number", number}});
  EXPECT_LT(resident_mb() - before_mb, 60) << "of 200 MB that were told";
  int seen = 0;
  std::string event;
  do {
    event = page.read_until("\n\n");
    ++seen;
  } while (!event.empty() && event.find(fmt::format("\"number\":{}}}", all)) == std::string::npos);
  EXPECT_FALSE(event.empty()) << "the last one arrives";
  EXPECT_LT(seen, all / 2);
  server->tell("news", {{"number", "next"}});
  EXPECT_EQ(page.read_until("\n\n"), "event: news\ndata: {\"number\":\"next\"}\n\n") << "and once";
}

TEST_F(TheWebServer, GivesUpAPageThatDoesNotRead) {
  options.write_timeout = 200ms;
  serve();
  RawBrowser page(server->port(), 4096);
  page.send(get("/live?topics=news"));
  EXPECT_TRUE(eventually([this] { return server->stats().streams == 1; }));
  const std::string filling(500'000, 'x');
  EXPECT_TRUE(eventually([&] {
    server->tell("news", {{"filling", filling}});
    return server->stats().streams == 0;
  }));
}

TEST_F(TheWebServer, KnowsWhichTopicsAreFollowedUntilThePageIsLeftOrReadsNoMore) {
  options.write_timeout = 200ms;
  serve();
  EXPECT_FALSE(server->has_followers("news"));
  {
    RawBrowser page(server->port());
    page.send(get("/live?topics=news"));
    EXPECT_THAT(page.read_until("\r\n\r\n"), StartsWith("HTTP/1.1 200 "));
    EXPECT_TRUE(server->has_followers("news"));
    EXPECT_FALSE(server->has_followers("weather"));
    RawBrowser other(server->port());
    other.send(get("/live?topics=news,weather"));
    EXPECT_THAT(other.read_until("\r\n\r\n"), StartsWith("HTTP/1.1 200 "));
    EXPECT_TRUE(server->has_followers("weather"));
  }
  EXPECT_TRUE(eventually([this] { return !server->has_followers("news") && !server->has_followers("weather"); }));

  RawBrowser hanging(server->port());
  hanging.send(get("/live?topics=news"));
  EXPECT_TRUE(eventually([this] { return server->has_followers("news"); }));
  std::size_t told = 0;
  const std::string filling(1000, 'x');
  EXPECT_TRUE(eventually([&] {
    server->tell("news", {{"filling", filling}});
    ++told;
    return !server->has_followers("news");
  }));
  EXPECT_LT(told, 1000U) << "what is kept for it is bounded: at 30 news of 1 kB a second that is half a minute";
}

TEST_F(TheWebServer, FollowsOnlySoManyPages) {
  options.most_streams = 1;
  serve();
  {
    RawBrowser first(server->port());
    first.send(get("/live?topics=news"));
    EXPECT_THAT(first.read_until("\r\n\r\n"), StartsWith("HTTP/1.1 200 "));
    EXPECT_THAT(ask(get("/live?topics=news")), StartsWith("HTTP/1.1 503 "));
  }
  EXPECT_TRUE(eventually([this] { return server->stats().streams == 0; }));
  RawBrowser next(server->port());
  next.send(get("/live?topics=news"));
  EXPECT_THAT(next.read_until("\r\n\r\n"), StartsWith("HTTP/1.1 200 "));
}

}  // namespace
}  // namespace telehug
