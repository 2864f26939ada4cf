// SPDX-License-Identifier: Apache-2.0
#include "web/web_connection.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <utility>

#include "service/open_metrics.hpp"

namespace telehug {
namespace asio = boost::asio;
namespace http = boost::beast::http;

namespace {

// Nothing from elsewhere, no script or style within a page, and no other page around ours.
constexpr const char* content_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

template <typename Fields>
void add_common_headers(Fields& fields) {
  fields.set("Content-Security-Policy", content_policy);
  fields.set("X-Content-Type-Options", "nosniff");
  fields.set("Referrer-Policy", "same-origin");
  fields.set("Cross-Origin-Opener-Policy", "same-origin");
  fields.set("Cross-Origin-Resource-Policy", "same-origin");
  fields.set(http::field::cache_control, "no-store");
}

// What may fail on a socket whose other end has gone; the next reading or writing tells.
void ignore(const boost::system::error_code& /*problem*/) {}

std::string_view view(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

// Empty if it is there twice: which of them would be meant?
template <typename Fields>
std::string_view only(const Fields& fields, http::field name) {
  const auto [first, end] = fields.equal_range(name);
  return first != end && std::next(first) == end ? view(first->value()) : std::string_view();
}

template <typename Message>
WebRequest request_of(const Message& message) {
  const std::string_view target = view(message.target());
  const auto question = target.find('?');
  WebRequest request;
  request.method = view(message.method_string());
  request.path = target.substr(0, question);
  if (question != std::string_view::npos) request.query = target.substr(question + 1);
  request.host = only(message, http::field::host);
  request.origin = only(message, http::field::origin);
  // One that is there twice is a foreign one.
  if (request.origin.empty() && message.count(http::field::origin) > 0) request.origin = "null";
  request.cookie = only(message, http::field::cookie);
  request.content_type = only(message, http::field::content_type);
  request.accept_language = only(message, http::field::accept_language);
  request.if_none_match = only(message, http::field::if_none_match);
  request.body = message.body();
  return request;
}

}  // namespace

WebConnection::WebConnection(Socket socket, Host& host, std::uint64_t number)
    : socket_(std::move(socket)),
      host_(host),
      number_(number),
      timer_(socket_.get_executor()),
      buffer_(host.options().most_header_bytes + host.options().most_body_bytes) {
  boost::system::error_code problem;
  ignore(socket_.set_option(asio::ip::tcp::no_delay(true), problem));
}

void WebConnection::start() {
  arm(host_.options().stranger_timeout);
  wait_for_request();
}

void WebConnection::close() {
  if (std::exchange(closed_, true)) return;
  boost::system::error_code problem;
  ignore(socket_.shutdown(Socket::shutdown_both, problem));
  ignore(socket_.close(problem));
  timer_.cancel();
  host_.closed(shared_from_this());
}

void WebConnection::arm(Duration after) {
  timer_.expires_after(after);
  timer_.async_wait([self = shared_from_this()](const boost::system::error_code& problem) {
    if (!problem) self->close();
  });
}

void WebConnection::wait_for_request() {
  if (known_) arm(host_.options().idle_timeout);
  if (buffer_.size() > 0) {
    read_request();
    return;
  }
  socket_.async_wait(Socket::wait_read, [self = shared_from_this()](const boost::system::error_code& problem) {
    if (self->closed_) return;
    if (problem) {
      self->close();
    } else {
      self->read_request();
    }
  });
}

void WebConnection::read_request() {
  // Once a request: who sends byte by byte gains no time, and a stranger has none but the connection's first.
  if (known_) arm(host_.options().request_timeout);
  parser_.emplace();
  parser_->header_limit(host_.options().most_header_bytes);
  parser_->body_limit(host_.options().most_body_bytes);
  http::async_read(
      socket_, buffer_, *parser_,
      [self = shared_from_this()](const boost::system::error_code& problem, std::size_t) { self->received(problem); });
}

void WebConnection::received(const boost::system::error_code& problem) {
  if (closed_) return;
  if (problem) {
    refuse(problem);
    return;
  }
  const auto& message = parser_->get();
  keep_alive_ = message.keep_alive();
  WebReply reply = host_.reply(request_of(message));
  known_ = reply.known;
  // Who is not known has to come again.
  if (!known_) keep_alive_ = false;
  if (auto* ready = std::get_if<WebAnswer>(&reply.what)) {
    answer(std::move(*ready));
  } else if (auto* command = std::get_if<WebCommand>(&reply.what)) {
    arm(host_.options().answer_timeout);
    awaits_command_ = true;
    asks_for_metrics_ = command->metrics;
    host_.ask(std::move(command->request), shared_from_this());
  } else {
    begin_stream(std::get<WebStream>(reply.what));
  }
}

void WebConnection::refuse(const boost::system::error_code& problem) {
  keep_alive_ = false;
  if (problem == http::error::header_limit || problem == http::error::buffer_overflow) {
    answer(WebSite::refusal(431, "the request's header is too long"));
  } else if (problem == http::error::body_limit) {
    answer(WebSite::refusal(413, "the request is too long"));
  } else if (problem.category() == http::make_error_code(http::error::bad_method).category() &&
             problem != http::error::end_of_stream && problem != http::error::partial_message) {
    answer(WebSite::refusal(400, "that is no HTTP/1.1"));
  } else {
    close();
  }
}

void WebConnection::answer(WebAnswer answer) {
  host_.answered(answer.status);
  response_.emplace(static_cast<http::status>(answer.status), 11U);
  add_common_headers(*response_);
  response_->set(http::field::content_type, answer.type);
  for (const auto& [name, value] : answer.headers)
    response_->set(name, value);
  response_->body() = std::move(answer.body);
  response_->keep_alive(keep_alive_);
  response_->prepare_payload();
  arm(host_.options().write_timeout);
  http::async_write(
      socket_, *response_,
      [self = shared_from_this()](const boost::system::error_code& problem, std::size_t) { self->written(problem); });
}

void WebConnection::answer_command(const nlohmann::json& said) {
  if (closed_ || !std::exchange(awaits_command_, false)) return;
  if (asks_for_metrics_) {
    answer_metrics(said);
    return;
  }
  answer({200, "application/json", said.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), {}});
}

void WebConnection::answer_metrics(const nlohmann::json& said) {
  const auto text = said.find("openmetrics");
  if (text == said.end() || !text->is_string()) {
    answer(WebSite::refusal(503, "the daemon tells no metrics"));
  } else {
    answer({200, std::string(open_metrics_type), text->get<std::string>(), {}});
  }
}

void WebConnection::written(const boost::system::error_code& problem) {
  if (closed_) return;
  response_.reset();
  parser_.reset();
  if (problem || !keep_alive_) {
    close();
    return;
  }
  wait_for_request();
}

void WebConnection::begin_stream(const WebStream& stream) {
  if (!host_.takes_stream(stream)) {
    keep_alive_ = false;
    answer(WebSite::refusal(503, "too many pages are open: close one"));
    return;
  }
  host_.answered(200);
  streaming_ = true;
  boost::system::error_code problem;
  ignore(socket_.set_option(Socket::send_buffer_size(host_.options().stream_buffer_bytes), problem));
  for (const std::string& topic : stream.topics)
    followed_[topic] = 0;
  parser_.reset();
  stream_head_.emplace(http::status::ok, 11U);
  add_common_headers(*stream_head_);
  stream_head_->set(http::field::content_type, "text/event-stream");
  stream_head_->keep_alive(false);
  stream_serializer_.emplace(*stream_head_);
  arm(host_.options().write_timeout);
  http::async_write_header(socket_, *stream_serializer_,
                           [self = shared_from_this()](const boost::system::error_code& unwritten, std::size_t) {
                             if (self->closed_) return;
                             self->timer_.cancel();
                             if (unwritten) {
                               self->close();
                               return;
                             }
                             self->stream_begun_ = true;
                             self->notice_end();
                             self->tell_news();
                           });
}

// Who follows says nothing more; a closed page ends its connection.
void WebConnection::notice_end() {
  socket_.async_read_some(asio::buffer(&ignored_, 1), [self = shared_from_this()](const boost::system::error_code&,
                                                                                  std::size_t) { self->close(); });
}

void WebConnection::tell_news() {
  if (!stream_begun_ || writing_ || closed_) return;
  for (auto& [topic, version] : followed_) {
    const auto newest = host_.live().newest(topic);
    if (newest.version == version) continue;
    version = newest.version;
    writing_ = newest.event;
    arm(host_.options().write_timeout);
    asio::async_write(socket_, asio::buffer(*writing_),
                      [self = shared_from_this()](const boost::system::error_code& problem, std::size_t) {
                        if (self->closed_) return;
                        self->timer_.cancel();
                        self->writing_ = nullptr;
                        if (problem) {
                          self->close();
                        } else {
                          self->tell_news();
                        }
                      });
    return;
  }
}

}  // namespace telehug
