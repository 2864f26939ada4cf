// SPDX-License-Identifier: Apache-2.0
//
// The texts of the real pages: no language lacks one, and no page asks for one that there is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

namespace telehug {
namespace {

using Json = nlohmann::json;
using Keys = std::set<std::string>;

const std::filesystem::path shared = TELEHUG_SOURCE "/common/web/pages/shared";
const std::vector<std::filesystem::path> sides{TELEHUG_SOURCE "/active_side/web", TELEHUG_SOURCE "/passive_side/web"};
const std::vector<std::string> languages{"en", "de", "fr"};

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Json texts_in(const std::filesystem::path& folder, const std::string& language) {
  return Json::parse(content_of(folder / ("texts." + language + ".json")));
}

Keys keys_of(const Json& texts) {
  Keys keys;
  for (const auto& [key, text] : texts.items())
    keys.insert(key);
  return keys;
}

Keys found(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  Keys all;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    all.insert((*at)[1].str());
  return all;
}

std::vector<std::filesystem::path> folders() {
  std::vector<std::filesystem::path> all{shared};
  for (const auto& side : sides)
    if (std::filesystem::exists(side)) all.push_back(side);
  return all;
}

// All that pages and scripts in a folder are made of.
std::string sources_in(const std::filesystem::path& folder) {
  std::string all;
  // Pages of both sides lie beside the folder of what pages share.
  if (folder == shared) all = sources_in(folder.parent_path());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".html" || entry.path().extension() == ".js") all += content_of(entry.path());
  return all;
}

TEST(TheTextsOfThePages, HaveTheSameKeysAndPlaceholdersInAllLanguages) {
  for (const auto& folder : folders()) {
    const Json english = texts_in(folder, "en");
    ASSERT_FALSE(english.empty());
    for (const std::string& language : languages) {
      const Json texts = texts_in(folder, language);
      EXPECT_EQ(keys_of(texts), keys_of(english)) << folder << language;
      for (const auto& [key, text] : texts.items()) {
        EXPECT_FALSE(text.get<std::string>().empty()) << key;
        EXPECT_EQ(found(text, "\\{(\\w+)\\}"), found(english.at(key), "\\{(\\w+)\\}")) << language << " " << key;
      }
    }
  }
}

TEST(TheTextsOfThePages, AreThereWhereverAPageAsksForOne) {
  for (const auto& folder : folders()) {
    Keys known = keys_of(texts_in(folder, "en"));
    known.merge(keys_of(texts_in(shared, "en")));
    const std::string sources = sources_in(folder);
    Keys asked = found(sources, "data-(?:text|label)=\"([^\"]+)\"");
    asked.merge(found(sources, "dataset\\.(?:text|label) = \"([^\"]+)\""));
    // Keys stand in text(...) as words of their own, also in conditions: "word.word". Pages' names look alike.
    asked.merge(found(sources, "\"([a-z]+\\.(?!html\")[a-z_]+)\""));
    EXPECT_GT(asked.size(), 1U);
    for (const std::string& key : asked)
      EXPECT_TRUE(known.contains(key)) << folder << " asks for \"" << key << "\"";
    // Of those that a script puts together at least one must begin so: text(`state.${...}`).
    for (const std::string& start : found(sources, "text\\(`([a-z_.]+)\\$\\{")) {
      EXPECT_TRUE(std::ranges::any_of(known, [&](const std::string& key) { return key.starts_with(start); }))
          << folder << " asks for \"" << start << "...\"";
    }
  }
}

TEST(TheTextsOfThePages, AreAllUsed) {
  std::string everything = content_of(TELEHUG_SOURCE "/common/web/web_site.cpp");
  for (const auto& folder : folders())
    everything += sources_in(folder);
  const Keys starts = found(everything, "text\\(`([a-z_.]+)\\$\\{");
  for (const auto& folder : folders()) {
    for (const std::string& key : keys_of(texts_in(folder, "en"))) {
      const bool begun = std::ranges::any_of(starts, [&](const std::string& start) { return key.starts_with(start); });
      EXPECT_TRUE(begun || everything.find('"' + key + '"') != std::string::npos) << "nobody uses \"" << key << "\"";
    }
  }
}

}  // namespace
}  // namespace telehug
