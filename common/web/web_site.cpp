// SPDX-License-Identifier: Apache-2.0
#include "web/web_site.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/outside_json.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr const char* json_type = "application/json";
constexpr std::string_view enter_path = "/enter";
constexpr std::string_view pictures_path = "/picture/";

// Those of a page and, in front of them, those that all pages share.
Json read_texts(const WebFiles& files, std::string_view language) {
  Json all = Json::object();
  for (const char* folder : {"/shared/", "/"}) {
    const std::string name = fmt::format("{}texts.{}.json", folder, language);
    const WebFile* file = files.find(name);
    const Json texts = file != nullptr ? Json::parse(file->content, nullptr, false) : Json();
    if (!texts.is_object() || std::ranges::any_of(texts, [](const Json& text) { return !text.is_string(); }))
      throw std::invalid_argument(fmt::format("web: \"{}\" is missing, or no object of texts", name));
    all.update(texts);
  }
  return all;
}

WebAnswer json_answer(const Json& json, unsigned status = 200) {
  return {status, json_type, json.dump(-1, ' ', false, Json::error_handler_t::replace), {}};
}

}  // namespace

WebSite::WebSite(WebSiteOptions options, WebFiles files) : options_(std::move(options)), files_(std::move(files)) {
  for (const std::string_view language : web_languages)
    texts_[language] = read_texts(files_, language);
}

std::string WebSite::new_link(Timestamp now) {
  return fmt::format("{}?link={}", enter_path, entrance_.new_link(now));
}

WebAnswer WebSite::refusal(unsigned status, std::string_view why) {
  WebAnswer answer{.status = status, .body = std::string(why) + "\n"};
  if (status == 405) answer.headers.emplace_back("Allow", "GET, POST");
  return answer;
}

WebReply WebSite::reply(const WebRequest& request, std::uint16_t port, Timestamp now) {
  if (const auto refused = refusal_of(request, port)) return {refusal(refused->status, refused->why)};
  const bool get = request.method == "GET";
  if (get && request.path == enter_path) return {enter(request, now)};
  if (get && options_.metrics && request.path == "/metrics") return {WebCommand{{{"command", "metrics"}}, true}};
  if (!entrance_.knows(cookie_value(request.cookie, options_.cookie), now))
    return {shut_door(request, 401, "door.no_session")};
  if (request.path == "/command" && !get) return {command(request), true};
  if (!get) return {refusal(405, "only /command takes POST"), true};
  if (request.path == "/live") return {stream(request), true};
  if (request.path == "/texts.json") return {texts(request), true};
  if (request.path.starts_with(pictures_path))
    return {picture(std::string(request.path.substr(pictures_path.size()))), true};
  return {file(request), true};
}

WebAnswer WebSite::enter(const WebRequest& request, Timestamp now) {
  const auto session = entrance_.enter(query_value(request.query, "link"), now);
  if (!session) return shut_door(request, 403, "door.link_used");
  return {303,
          "text/plain; charset=utf-8",
          "",
          {{"Location", "/"},
           {"Set-Cookie", fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", options_.cookie, *session)}}};
}

// The only page without files of its own, which nobody without a session gets.
WebAnswer WebSite::shut_door(const WebRequest& request, unsigned status, const std::string& why) const {
  const std::string_view language = preferred_language(request.accept_language, web_languages);
  const Json& texts = texts_.at(language);
  return {status,
          "text/html; charset=utf-8",
          fmt::format("<!DOCTYPE html>\n<html lang=\"{}\"><meta charset=\"utf-8\"><title>telehug</title>"
                      "<main><h1>telehug</h1><p>{}</p></main></html>\n",
                      language, texts.at(why).get<std::string>()),
          {}};
}

WebAnswer WebSite::file(const WebRequest& request) const {
  const WebFile* found = files_.find(request.path);
  if (found == nullptr) return refusal(404, "there is no such page");
  // Kept by the browser, which asks each time whether it is still the one.
  const std::vector<std::pair<std::string, std::string>> headers{{"ETag", found->etag}, {"Cache-Control", "no-cache"}};
  if (request.if_none_match == found->etag) return {304, std::string(found->type), "", headers};
  return {200, std::string(found->type), std::string(found->content), headers};
}

WebAnswer WebSite::picture(const std::string& name) const {
  const auto found = options_.pictures.find(name);
  if (found == options_.pictures.end()) return refusal(404, "there is no such picture");
  const auto newest = found->second();
  if (!newest) return {.status = 204, .headers = {{"Cache-Control", "no-store"}}};
  return {200, "image/jpeg", *newest, {{"Cache-Control", "no-store"}}};
}

WebAnswer WebSite::texts(const WebRequest& request) const {
  std::string_view language = query_value(request.query, "lang");
  if (!texts_.contains(language)) language = preferred_language(request.accept_language, web_languages);
  return json_answer({{"language", language}, {"languages", web_languages}, {"texts", texts_.at(language)}});
}

std::variant<WebAnswer, WebCommand, WebStream> WebSite::stream(const WebRequest& request) const {
  std::set<std::string> topics;
  std::string_view names = query_value(request.query, "topics");
  while (!names.empty()) {
    const auto end = names.find(',');
    std::string topic(names.substr(0, end));
    if (!options_.topics.contains(topic)) return refusal(404, "there is no such topic");
    topics.insert(std::move(topic));
    names.remove_prefix(end == std::string_view::npos ? names.size() : end + 1);
  }
  if (topics.empty()) return refusal(404, "which topics? /live?topics=NAME,NAME");
  return WebStream{{topics.begin(), topics.end()}};
}

std::variant<WebAnswer, WebCommand, WebStream> WebSite::command(const WebRequest& request) const {
  Json order = parse_outside_json(request.body);
  if (!order.is_object() || !order.contains("command") || !order["command"].is_string())
    return json_answer({{"error", "a request is an object such as {\"command\":\"status\"}"}}, 400);
  if (!options_.commands.contains(order["command"].get_ref<const std::string&>()))
    return json_answer({{"error", "pages may not send this command"}}, 403);
  return WebCommand{std::move(order)};
}

}  // namespace telehug
