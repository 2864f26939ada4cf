// SPDX-License-Identifier: Apache-2.0
#include "web/web_files.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace telehug {
namespace {

constexpr EmbeddedFile some[] = {{"index.html", "<p>"}, {"shared/page.js", "1"}};

TEST(TheFilesOfThePages, AreFoundByTheirExactNamesAlone) {
  const WebFiles files({some});
  ASSERT_NE(files.find("/index.html"), nullptr);
  EXPECT_EQ(files.find("/index.html")->content, "<p>");
  EXPECT_EQ(files.find("/"), files.find("/index.html"));
  EXPECT_NE(files.find("/shared/page.js"), nullptr);
  for (const char* path : {"", "index.html", "//index.html", "/index.html/", "/INDEX.HTML", "/shared", "/shared/",
                           "/./index.html", "/shared/../index.html", "/..%2findex.html", "/%69ndex.html",
                           "/../../../../etc/passwd", "/index.html\\", "http://127.0.0.1/index.html"}) {
    EXPECT_EQ(files.find(path), nullptr) << path;
  }
  EXPECT_EQ(files.find(std::string_view("/index.html\0", 12)), nullptr);
}

TEST(TheFilesOfThePages, HaveTheTypesOfTheirEndings) {
  const WebFiles files({some});
  EXPECT_EQ(files.find("/")->type, "text/html; charset=utf-8");
  EXPECT_EQ(files.find("/shared/page.js")->type, "text/javascript; charset=utf-8");
  EXPECT_EQ(web_type("a.css"), "text/css; charset=utf-8");
  EXPECT_EQ(web_type("a.json"), "application/json");
  EXPECT_EQ(web_type("a.svg"), "image/svg+xml");
  EXPECT_EQ(web_type("a.png"), "image/png");
  EXPECT_EQ(web_type("a.exe"), std::nullopt);
  EXPECT_EQ(web_type("html"), std::nullopt);
}

TEST(TheFilesOfThePages, HaveATagThatChangesWithTheContent) {
  constexpr EmbeddedFile newer[] = {{"index.html", "<b>"}};
  const WebFiles files({some});
  EXPECT_EQ(files.find("/")->etag, WebFiles({some}).find("/")->etag);
  EXPECT_NE(files.find("/")->etag, WebFiles({newer}).find("/")->etag);
  EXPECT_EQ(files.find("/")->etag.front(), '"');
  EXPECT_EQ(files.find("/")->etag.back(), '"');
}

TEST(TheFilesOfThePages, AreRefusedIfTwoAreCalledTheSameOrNoTypeIsKnown) {
  constexpr EmbeddedFile strange[] = {{"a.exe", ""}};
  EXPECT_THROW(WebFiles({some, some}), std::invalid_argument);
  EXPECT_THROW(WebFiles({strange}), std::invalid_argument);
}

}  // namespace
}  // namespace telehug
