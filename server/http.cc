#include "server/http.h"

#include <arpa/inet.h>
#include <httplib.h>

#include <cstdio>
#include <thread>

#include "server/designs_resource.h"
#include "server/diagnoses_resource.h"
#include "server/limits.h"
#include "server/routes.h"

namespace plenum::server {
namespace {

// httplib decides from the request's headers how it reads a body and compresses an answer, and
// gives handlers a const view of a request that is not const.
httplib::Headers& MutableHeaders(const httplib::Request& request) {
  return const_cast<httplib::Request&>(request).headers;
}

// The name in an Origin such as "http://localhost:8080".
std::string HostOf(const std::string& origin) {
  auto start = origin.find("://");
  start = start == std::string::npos ? 0 : start + 3;
  if (origin.compare(start, 1, "[") == 0) {
    return origin.substr(start + 1, origin.find(']', start) - start - 1);
  }
  return origin.substr(start, origin.find(':', start) - start);
}

enum class BodyStatus { kRead, kTooLarge, kEncoded, kBroken };
struct Body {
  BodyStatus status = BodyStatus::kRead;
  std::string text;
  bool at_end = true;  // nothing of the body is left in the connection
};

Body ReadBody(const httplib::Request& request, const httplib::ContentReader* reader) {
  Body body;
  const bool has_body =
      request.has_header("Transfer-Encoding") ||
      (request.has_header("Content-Length") && request.get_header_value("Content-Length") != "0");
  if (!reader || !has_body) return body;
  // Read as it comes: never inflated, never taken apart as a form.
  if (request.has_header("Content-Encoding") || request.is_multipart_form_data()) {
    body.status = BodyStatus::kEncoded;
    MutableHeaders(request).erase("Content-Encoding");
    MutableHeaders(request).erase("Content-Type");
  }
  std::size_t size = 0;
  body.at_end = (*reader)([&](const char* data, std::size_t length) {
    size += length;
    if (body.status == BodyStatus::kRead && size > kBodyBytesMax) {
      body.status = BodyStatus::kTooLarge;
      body.text = {};
    }
    if (body.status == BodyStatus::kRead) body.text.append(data, length);
    return size <= kBodyBytesRead;
  });
  if (!body.at_end && body.status == BodyStatus::kRead) body.status = BodyStatus::kBroken;
  return body;
}

// Sends the reply and then closes the connection: a provider that fails after its last byte is the
// way to tell httplib so. Needed where unread bytes would be taken for the next request.
void SendAndClose(const Reply& reply, httplib::Response& response) {
  response.set_header("Connection", "close");
  response.set_content_provider(
      reply.body.size(), reply.content_type,
      [text = reply.body](std::size_t, std::size_t, httplib::DataSink& sink) {
        sink.write(text.data(), text.size());
        return false;
      });
}

void Send(const Reply& reply, httplib::Response& response, bool close) {
  response.status = reply.status;
  for (const auto& [name, value] : reply.headers) response.set_header(name.c_str(), value);
  if (reply.stream) {
    response.set_chunked_content_provider(
        reply.content_type, [stream = reply.stream](std::size_t, httplib::DataSink& sink) {
          const auto write = [&](std::string_view text) {
            return sink.is_writable() && sink.write(text.data(), text.size());
          };
          if (!stream(write)) sink.done();
          return sink.is_writable();
        });
  } else if (close) {
    SendAndClose(reply, response);
  } else if (!reply.content_type.empty() && !reply.body.empty()) {
    response.set_content(reply.body, reply.content_type);
  }
}

Call ToCall(const httplib::Request& request, std::string argument, std::string body) {
  return {std::move(argument), request.params,
          [&request](const char* name) -> std::optional<std::string> {
            if (!request.has_header(name)) return std::nullopt;
            return request.get_header_value(name);
          },
          std::move(body), request.path};
}

}  // namespace

bool IsLoopback(const std::string& host) {
  if (host == "localhost" || host == "::1") return true;
  in_addr address{};
  return inet_pton(AF_INET, host.c_str(), &address) == 1 && ntohl(address.s_addr) >> 24 == 127;
}

struct HttpService::Impl {
  // The port first: without it no job is begun.
  explicit Impl(const HttpOptions& options)
      : port(Bind(options)),
        catalog(options.catalog),
        jobs(options.catalog.string() + "-jobs", options.kept),
        designs(jobs, "design", DesignWork(catalog), options.jobs),
        diagnoses(jobs, "diagnosis", DiagnosisWork(catalog), options.jobs),
        routes(Routes(catalog, designs, diagnoses)) {
    SetHandlers();
  }

  int Bind(const HttpOptions& options) {
    SetLimits();
    const bool any = options.port == 0;
    const int bound = any ? server.bind_to_any_port(options.host)
                      : server.bind_to_port(options.host, options.port) ? options.port
                                                                        : -1;
    if (bound <= 0) {
      throw ListenError("cannot listen at " + options.host + " port " +
                        std::to_string(options.port) + ": is it taken by another program?");
    }
    return bound;
  }

  void SetLimits() {
    server.set_tcp_nodelay(true);
    server.new_task_queue = [] { return new httplib::ThreadPool(kRequestThreads); };
    server.set_keep_alive_max_count(1000);
    // The default shares a port with whoever listens there already.
    server.set_socket_options([](socket_t socket) {
      const int on = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
  }

  void SetHandlers() {
    server.set_pre_routing_handler([](const auto& request, auto& response) {
      MutableHeaders(request).erase("Accept-Encoding");
      MutableHeaders(request).erase("Range");
      if (request.path.size() > kPathBytesMax) {
        Send(ProblemReply(414, "the path must be ≤ 1024 bytes"), response, true);
        return httplib::Server::HandlerResponse::Handled;
      }
      return httplib::Server::HandlerResponse::Unhandled;
    });
    server.set_exception_handler([](const auto& request, auto& response, std::exception_ptr fault) {
      Send(FaultReply(request, fault), response, true);
    });
    // What httplib itself refuses has no body yet.
    server.set_error_handler([](const auto&, auto& response) {
      if (!response.body.empty() || response.content_provider_) return;
      Send(ProblemReply(response.status, "the request could not be read"), response, false);
    });
    const std::string all = R"([\s\S]*)";
    const auto without_body = [this](const auto& request, auto& response) {
      Answer(request, response, nullptr);
    };
    const auto with_body = [this](const auto& request, auto& response, const auto& reader) {
      Answer(request, response, &reader);
    };
    server.Get(all, without_body);
    server.Options(all, without_body);
    server.Post(all, httplib::Server::HandlerWithContentReader(with_body));
    server.Put(all, httplib::Server::HandlerWithContentReader(with_body));
    server.Patch(all, httplib::Server::HandlerWithContentReader(with_body));
    server.Delete(all, httplib::Server::HandlerWithContentReader(with_body));
  }

  // The log gets all of it, the client what it can act on.
  static Reply FaultReply(const httplib::Request& request, const std::exception_ptr& fault) {
    std::string what = "unknown";
    auto store_fault = catalog::StoreFault::kOther;
    try {
      std::rethrow_exception(fault);
    } catch (const catalog::StoreError& error) {
      what = error.what();
      store_fault = error.fault();
    } catch (const std::exception& error) {
      what = error.what();
    } catch (...) {
    }
    std::fprintf(stderr, "%s %s: %s\n", request.method.c_str(), request.path.c_str(), what.c_str());
    if (store_fault == catalog::StoreFault::kStorage)
      return ProblemReply(507,
                          "the catalogue cannot be written or read: its disk is full or fails; "
                          "nothing was changed");
    if (store_fault == catalog::StoreFault::kOther)
      return ProblemReply(500, "a fault of the program; its log says more");
    auto reply = ProblemReply(503, "another process holds the catalogue; nothing was changed");
    reply.headers.emplace_back("Retry-After", "5");
    return reply;
  }

  void Answer(const httplib::Request& request, httplib::Response& response,
              const httplib::ContentReader* reader) {
    Body body = ReadBody(request, reader);
    response.status = -1;  // set by httplib when the reader stopped
    const Reply reply = Respond(request, body);
    Send(reply, response, !body.at_end);
  }

  Reply Respond(const httplib::Request& request, Body& body) {
    switch (body.status) {
      case BodyStatus::kTooLarge:
        return ProblemReply(413, "the body must be ≤ 8 MiB");
      case BodyStatus::kEncoded:
        return ProblemReply(415, "send the body itself: no Content-Encoding, no form");
      case BodyStatus::kBroken:
        return ProblemReply(400, "the body ended early or is not well-formed");
      case BodyStatus::kRead:
        break;
    }
    // A page of another site may not act on the service through its user's browser.
    const std::string origin = request.get_header_value("Origin");
    if (!origin.empty() && !IsLoopback(HostOf(origin))) {
      return ProblemReply(403, "requests from pages of another site are refused");
    }
    return Dispatch(request, std::move(body.text));
  }

  Reply Dispatch(const httplib::Request& request, std::string body) {
    const std::string method = request.method == "HEAD" ? "GET" : request.method;
    std::string allowed;
    for (const auto& route : routes) {
      std::string argument;
      if (!Matches(route, request.path, argument)) continue;
      if (route.method == method) {
        return route.answer(ToCall(request, std::move(argument), std::move(body)));
      }
      allowed += (allowed.empty() ? "" : ", ") + route.method;
    }
    if (allowed.empty()) return ProblemReply(404, "there is no " + request.path);
    auto reply = ProblemReply(405, request.path + " takes " + allowed);
    reply.headers.emplace_back("Allow", allowed);
    return reply;
  }

  httplib::Server server;
  const int port;
  SharedCatalog catalog;
  catalog::JobStore jobs;
  Jobs designs, diagnoses;
  const std::vector<Route> routes;
};

HttpService::HttpService(const HttpOptions& options) : impl_(std::make_unique<Impl>(options)) {}
HttpService::~HttpService() = default;

int HttpService::port() const { return impl_->port; }

void HttpService::Run() { impl_->server.listen_after_bind(); }

void HttpService::Stop() {
  impl_->designs.Stop();
  impl_->diagnoses.Stop();
  // A stop before the listening has begun would be lost.
  while (!impl_->server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  impl_->server.stop();
}

}  // namespace plenum::server
