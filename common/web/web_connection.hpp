// SPDX-License-Identifier: Apache-2.0
//
// One connection of a browser. Only WebServer uses it; everything runs in the server's thread.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/string_body.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "web/live_topics.hpp"
#include "web/web_server.hpp"

namespace telehug {

class WebConnection : public std::enable_shared_from_this<WebConnection> {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  // What a connection asks of its server.
  class Host {
   public:
    virtual ~Host() = default;
    [[nodiscard]] virtual const WebServerOptions& options() const = 0;
    [[nodiscard]] virtual WebReply reply(const WebRequest& request) = 0;
    virtual void ask(nlohmann::json request, const std::shared_ptr<WebConnection>& connection) = 0;
    [[nodiscard]] virtual const LiveTopics& live() const = 0;
    [[nodiscard]] virtual bool takes_stream(const WebStream& stream) = 0;
    virtual void answered(unsigned status) = 0;
    virtual void closed(const std::shared_ptr<WebConnection>& connection) = 0;
  };

  WebConnection(Socket socket, Host& host, std::uint64_t number);

  void start();
  void close();

  // What the daemon said to the command of the last request.
  void answer_command(const nlohmann::json& answer);
  // There may be news: of what it follows, if it does.
  void tell_news();

  [[nodiscard]] bool known() const noexcept { return known_; }
  [[nodiscard]] bool streaming() const noexcept { return streaming_; }
  // Topics, and the version of each that was last written.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& followed() const noexcept { return followed_; }
  [[nodiscard]] std::uint64_t number() const noexcept { return number_; }  // grows with each connection

 private:
  void wait_for_request();
  void read_request();
  void received(const boost::system::error_code& problem);
  void refuse(const boost::system::error_code& problem);
  void answer(WebAnswer answer);
  void answer_metrics(const nlohmann::json& said);
  void written(const boost::system::error_code& problem);
  void begin_stream(const WebStream& stream);
  void notice_end();
  void arm(Duration after);

  Socket socket_;
  Host& host_;
  const std::uint64_t number_;
  boost::asio::steady_timer timer_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  std::optional<boost::beast::http::response<boost::beast::http::string_body>> response_;
  bool known_ = false;
  bool keep_alive_ = false;
  bool awaits_command_ = false;
  bool asks_for_metrics_ = false;
  bool closed_ = false;

  bool streaming_ = false;
  std::optional<boost::beast::http::response<boost::beast::http::empty_body>> stream_head_;
  std::optional<boost::beast::http::response_serializer<boost::beast::http::empty_body>> stream_serializer_;
  std::map<std::string, std::uint64_t> followed_;
  std::shared_ptr<const std::string> writing_;  // an event
  bool stream_begun_ = false;
  char ignored_ = 0;
};

}  // namespace telehug
