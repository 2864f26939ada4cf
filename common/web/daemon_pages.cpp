// SPDX-License-Identifier: Apache-2.0
#include "web/daemon_pages.hpp"

#include <spdlog/spdlog.h>

#include "service/control_socket.hpp"
#include "service/log.hpp"

namespace telehug {

std::span<const EmbeddedFile> shared_pages();  // generated

namespace {
using Json = nlohmann::json;
}

DaemonPages::DaemonPages(const WebConfig& config, const DaemonPagesOptions& options, ControlServer& control,
                         const Clock& clock)
    : side_(options.side) {
  for (const auto files : {shared_pages(), options.files})
    for (const EmbeddedFile& file : files)
      if (file.name.ends_with(".html")) pages_.emplace_back(file.name);
  if (config.enabled) {
    const auto ask = [&control](Json request, WebServer::Answered answered) {
      control.ask(std::move(request), std::move(answered));
    };
    try {
      server_ = std::make_unique<WebServer>(WebServerOptions{.port = static_cast<std::uint16_t>(config.port)},
                                            WebSiteOptions{"telehug-" + side_name(side_), options.commands,
                                                           options.topics, options.pictures, config.metrics},
                                            WebFiles({shared_pages(), options.files}), ask, clock);
    } catch (const std::runtime_error& problem) {
      problem_ = problem.what();
      log_about({.stage = "web"}, spdlog::level::err, problem_);
    }
  }
  control.on("open", [this](const Json&) { return open(); });
}

void DaemonPages::start() {
  if (!server_) return;
  server_->start();
  spdlog::info("the pages are on http://127.0.0.1:{}; `telehug open` opens them", server_->port());
}

void DaemonPages::stop() {
  if (server_) server_->stop();
}

void DaemonPages::tell(const std::string& topic, const Json& news) {
  if (server_) server_->tell(topic, news);
}

void DaemonPages::add_status(Json& status) const {
  if (server_) status["web"] = {{"port", server_->port()}, {"pages", pages_}};
  if (!problem_.empty())
    status["problems"].push_back({{"what", problem_}, {"do", "set web.port to another one, or to 0, and start anew"}});
}

Json DaemonPages::open() {
  if (server_) return {{"side", side_name(side_)}, {"url", server_->new_link()}};
  if (!problem_.empty()) return {{"error", problem_}};
  return {{"error", "the pages are switched off: set web.enabled to true and start anew"}};
}

}  // namespace telehug
