// SPDX-License-Identifier: Apache-2.0
#include "web/web_site.hpp"

#include <gmock/gmock.h>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;

constexpr std::uint16_t port = 8077;

constexpr EmbeddedFile files[] = {
    {"index.html", "<p>page"},
    {"texts.en.json", R"({"mine":"my"})"},
    {"texts.de.json", R"({"mine":"mein"})"},
    {"texts.fr.json", R"({"mine":"mon"})"},
    {"shared/texts.en.json", R"({"door.no_session":"come in","door.link_used":"used"})"},
    {"shared/texts.de.json", R"({"door.no_session":"komm herein","door.link_used":"benutzt"})"},
    {"shared/texts.fr.json", R"({"door.no_session":"entrez","door.link_used":"servi"})"},
};

std::string header(const WebAnswer& answer, const std::string& name) {
  for (const auto& [given, value] : answer.headers)
    if (given == name) return value;
  return "";
}

class TheWebSite : public testing::Test {
 protected:
  [[nodiscard]] static WebRequest get(std::string_view path, std::string_view query = "") {
    WebRequest request;
    request.method = "GET";
    request.path = path;
    request.query = query;
    request.host = "127.0.0.1:8077";
    return request;
  }
  [[nodiscard]] WebRequest post(std::string_view body) const {
    WebRequest request = get("/command");
    request.method = "POST";
    request.origin = "http://127.0.0.1:8077";
    request.content_type = "application/json";
    request.cookie = cookie;
    request.body = body;
    return request;
  }
  [[nodiscard]] WebReply reply(const WebRequest& request) { return site.reply(request, port, clock.now()); }
  [[nodiscard]] WebAnswer answer(const WebRequest& request) { return std::get<WebAnswer>(reply(request).what); }
  [[nodiscard]] WebAnswer follow_new_link() {
    const std::string link = site.new_link(clock.now());
    const auto question = link.find('?');
    return answer(get(std::string_view(link).substr(0, question), std::string_view(link).substr(question + 1)));
  }
  void enter() {
    const std::string set = header(follow_new_link(), "Set-Cookie");
    cookie = set.substr(0, set.find(';'));
  }
  // With the session's cookie.
  [[nodiscard]] WebAnswer fetch(std::string_view path, std::string_view query = "") {
    WebRequest request = get(path, query);
    request.cookie = cookie;
    return answer(request);
  }

  FakeClock clock;
  std::shared_ptr<const std::string> newest_picture;
  int pictures_asked = 0;
  WebSite site{{"telehug-test",
                {"status", "pause"},
                {"news", "weather"},
                {{"camera.jpg",
                  [this] {
                    ++pictures_asked;
                    return newest_picture;
                  }}}},
               WebFiles({files})};
  std::string cookie;
};

TEST_F(TheWebSite, OpensASessionByALinkAndLeadsToThePage) {
  const WebAnswer opened = follow_new_link();
  EXPECT_EQ(opened.status, 303U);
  EXPECT_EQ(header(opened, "Location"), "/");
  EXPECT_THAT(header(opened, "Set-Cookie"), StartsWith("telehug-test="));
  EXPECT_THAT(header(opened, "Set-Cookie"), HasSubstr("; Path=/; HttpOnly; SameSite=Strict"));
}

TEST_F(TheWebSite, SaysInTheReadersLanguageThatALinkIsUsedUp) {
  const std::string link = site.new_link(clock.now());
  WebRequest request = get("/enter", std::string_view(link).substr(link.find('?') + 1));
  request.accept_language = "fr";
  EXPECT_EQ(answer(request).status, 303U);
  EXPECT_EQ(answer(request).status, 403U);
  EXPECT_THAT(answer(request).body, HasSubstr("servi"));
}

TEST_F(TheWebSite, ShowsNothingToWhoHasNoSession) {
  enter();
  for (const char* path : {"/", "/index.html", "/texts.json", "/live", "/command", "/nothing"}) {
    WebRequest request = get(path, "topics=news");
    request.accept_language = "de";
    for (const std::string& wrong : {std::string(), cookie + "0", "other" + cookie, cookie + "; " + cookie}) {
      request.cookie = wrong;
      EXPECT_EQ(answer(request).status, 401U) << path << wrong;
      EXPECT_THAT(answer(request).body, HasSubstr("komm herein"));
      EXPECT_FALSE(reply(request).known);
    }
  }
  WebRequest order = post(R"({"command":"status"})");
  order.cookie = "";
  EXPECT_EQ(answer(order).status, 401U);
}

TEST_F(TheWebSite, RefusesAForeignRequestBeforeItLooksForASession) {
  const std::string link = site.new_link(clock.now());
  const std::string query = link.substr(link.find('?') + 1);
  WebRequest request = get("/enter", query);
  request.host = "evil.example:8077";
  EXPECT_EQ(answer(request).status, 421U);
  request = get("/enter", query);
  request.origin = "http://evil.example";
  EXPECT_EQ(answer(request).status, 403U);
  EXPECT_EQ(answer(get("/enter", query)).status, 303U) << "the link has not been used up by that";
}

TEST_F(TheWebSite, ServesFilesWithATagByWhichTheBrowserNeedsThemOnce) {
  enter();
  const WebAnswer page = fetch("/");
  EXPECT_EQ(page.status, 200U);
  EXPECT_EQ(page.body, "<p>page");
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  WebRequest request = get("/");
  request.cookie = cookie;
  const std::string etag = header(page, "ETag");
  request.if_none_match = etag;
  EXPECT_EQ(answer(request).status, 304U);
  EXPECT_EQ(answer(request).body, "");
  request.if_none_match = "\"0\"";
  EXPECT_EQ(answer(request).status, 200U);
  EXPECT_EQ(fetch("/../web_site.cpp").status, 404U);
}

TEST_F(TheWebSite, ShowsTheNewestOfALivePictureWhichNobodyKeeps) {
  enter();
  newest_picture = std::make_shared<const std::string>("first");
  EXPECT_EQ(fetch("/picture/camera.jpg").body, "first");
  newest_picture = std::make_shared<const std::string>("second");
  const WebAnswer picture = fetch("/picture/camera.jpg", "n=2");
  EXPECT_EQ(picture.body, "second");
  EXPECT_EQ(picture.type, "image/jpeg");
  EXPECT_EQ(header(picture, "Cache-Control"), "no-store");
  EXPECT_EQ(pictures_asked, 2);
}

TEST_F(TheWebSite, SaysThatThereIsNoPictureAtPresentOrNoneOfThatName) {
  enter();
  EXPECT_EQ(fetch("/picture/camera.jpg").status, 204U);
  EXPECT_EQ(fetch("/picture/camera.jpg").body, "");
  EXPECT_EQ(fetch("/picture/other.jpg").status, 404U);
  EXPECT_EQ(fetch("/picture/").status, 404U);
}

TEST_F(TheWebSite, MakesNoPictureForStrangers) {
  newest_picture = std::make_shared<const std::string>("secret");
  EXPECT_EQ(answer(get("/picture/camera.jpg")).status, 401U);
  enter();
  WebRequest foreign = get("/picture/camera.jpg");
  foreign.cookie = cookie;
  foreign.origin = "http://evil.example";
  EXPECT_EQ(answer(foreign).status, 403U);
  foreign.origin = "";
  foreign.host = "evil.example:8077";
  EXPECT_EQ(answer(foreign).status, 421U);
  EXPECT_EQ(pictures_asked, 0);
}

TEST_F(TheWebSite, GivesTheTextsInTheLanguageThatIsAskedForOrLiked) {
  enter();
  const Json english = Json::parse(fetch("/texts.json").body);
  EXPECT_EQ(english.at("language"), "en");
  EXPECT_EQ(english.at("languages"), Json({"en", "de", "fr"}));
  EXPECT_EQ(english.at("texts"), Json({{"mine", "my"}, {"door.no_session", "come in"}, {"door.link_used", "used"}}));
  EXPECT_EQ(Json::parse(fetch("/texts.json", "lang=de").body).at("texts").at("mine"), "mein");
  EXPECT_EQ(Json::parse(fetch("/texts.json", "lang=it").body).at("language"), "en");
  WebRequest request = get("/texts.json");
  request.cookie = cookie;
  request.accept_language = "fr-CA";
  EXPECT_EQ(Json::parse(answer(request).body).at("language"), "fr");
}

TEST_F(TheWebSite, PassesOnThoseCommandsThatPagesMaySend) {
  enter();
  const std::string body = R"({"command":"pause","minutes":5})";
  const WebReply passed = reply(post(body));
  EXPECT_TRUE(passed.known);
  EXPECT_EQ(std::get<WebCommand>(passed.what).request, Json::parse(body));
  EXPECT_EQ(answer(post(R"({"command":"open"})")).status, 403U);
  EXPECT_EQ(answer(post(R"({"command":"watch"})")).status, 403U);
}

TEST_F(TheWebSite, RefusesACommandThatIsNone) {
  enter();
  const std::string deep = R"({"command":"status","x":)" + std::string(5000, '[') + std::string(5000, ']') + "}";
  for (const std::string& body : {std::string(), std::string("{"), std::string("[]"), std::string("\"status\""),
                                  std::string("{}"), std::string(R"({"command":7})"), deep}) {
    EXPECT_EQ(answer(post(body)).status, 400U) << body.substr(0, 40);
  }
}

TEST_F(TheWebSite, TakesCommandsByPostAtOnePlaceOnly) {
  enter();
  WebRequest elsewhere = post(R"({"command":"status"})");
  elsewhere.path = "/";
  EXPECT_EQ(answer(elsewhere).status, 405U);
  EXPECT_EQ(header(answer(elsewhere), "Allow"), "GET, POST");
  EXPECT_EQ(fetch("/command").status, 404U);
}

TEST_F(TheWebSite, BeginsAStreamOfTopicsThatThereAre) {
  enter();
  WebRequest request = get("/live", "topics=weather,news,news");
  request.cookie = cookie;
  EXPECT_EQ(std::get<WebStream>(reply(request).what).topics, (std::vector<std::string>{"news", "weather"}));
  for (const char* query : {"", "topics=", "topics=secrets", "topics=,news", "topics=news,secrets"}) {
    request.query = query;
    EXPECT_EQ(answer(request).status, 404U) << query;
  }
}

TEST_F(TheWebSite, TellsItsMetricsToAnybodyOnThisPcIfThatIsSwitchedOnAndNeverUnderAnotherName) {
  EXPECT_EQ(answer(get("/metrics")).status, 401U);
  WebSite open{{.cookie = "telehug-test", .commands = {}, .topics = {}, .metrics = true}, WebFiles({files})};
  const WebReply told = open.reply(get("/metrics"), port, clock.now());
  const auto& command = std::get<WebCommand>(told.what);
  EXPECT_EQ(command.request, Json({{"command", "metrics"}}));
  EXPECT_TRUE(command.metrics);
  EXPECT_FALSE(told.known);
  WebRequest rebound = get("/metrics");
  rebound.host = "evil.example:8077";
  EXPECT_EQ(std::get<WebAnswer>(open.reply(rebound, port, clock.now()).what).status / 100, 4U);
  WebRequest order = post(R"({"command":"status"})");
  order.cookie = "";
  EXPECT_EQ(std::get<WebAnswer>(open.reply(order, port, clock.now()).what).status, 401U);
}

TEST_F(TheWebSite, IsNotMadeOfTextsThatAreMissingOrNone) {
  constexpr EmbeddedFile none[] = {{"index.html", ""}};
  EXPECT_THROW(WebSite({}, WebFiles({none})), std::invalid_argument);
}

}  // namespace
}  // namespace telehug
