// SPDX-License-Identifier: Apache-2.0
#include "validator/view/view_server.h"

#include "renderer/core/error.h"
#include "renderer/core/parse_number.h"
#include "validator/report/embedded_files.h"
#include "validator/view/sequence_view.h"

#include <httplib.h>
#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

constexpr const char* kLoopback = "127.0.0.1";

int NumberOf(const httplib::Request& request, const char* name) {
  const std::optional<int> number = ParseNumber<int>(request.get_param_value(name));
  if (!number) {
    throw InputError("{}: expected a whole number, got '{}'", name, request.get_param_value(name));
  }
  return *number;
}

ViewRequest RequestOf(const httplib::Request& request) {
  return {request.get_param_value("lens"),
          request.get_param_value("camera"),
          request.get_param_value("channel"),
          NumberOf(request, "frame")};
}

std::string Page() {
  std::string page(EmbeddedFile("validator/view/page/view.html"));
  for (const auto& [mark, path] : {std::pair{"/* STYLES */", "validator/view/page/view.css"},
                                   std::pair{"/* SCRIPTS */", "validator/view/page/view.js"}}) {
    page.replace(page.find(mark), std::string_view(mark).size(), EmbeddedFile(path));
  }
  return page;
}

/// Answers with what `answer` says; its InputError is the visitor's fault.
template <typename Answer>
httplib::Server::Handler Answering(const Answer& answer) {
  return [answer](const httplib::Request& request, httplib::Response& response) {
    try {
      answer(request, response);
    } catch (const InputError& error) {
      response.status = 404;
      response.set_content(error.what(), "text/plain; charset=utf-8");
    }
  };
}

}  // namespace

bool IsOwnHost(const std::string& host, int port) {
  const std::string suffix = ":" + std::to_string(port);
  return host == std::string(kLoopback) + suffix || host == "localhost" + suffix;
}

void ServeSequence(const std::filesystem::path& folder,
                   int port,
                   const std::function<void(const std::string& address)>& is_ready) {
  const SequenceView view(folder);
  httplib::Server server;
  // The library would share the port with another program that listens there.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const bool is_any = port == 0;
  if (is_any ? (port = server.bind_to_any_port(kLoopback)) < 0
             : !server.bind_to_port(kLoopback, port)) {
    throw SystemError("cannot listen at {}:{}: is it taken? --port 0 takes a free one",
                      kLoopback,
                      is_any ? 0 : port);
  }
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"Cache-Control", "no-store"},
                              {"Referrer-Policy", "no-referrer"}});
  server.set_pre_routing_handler(
      [port](const httplib::Request& request, httplib::Response& response) {
        if (request.method == "GET" && IsOwnHost(request.get_header_value("Host"), port)) {
          return httplib::Server::HandlerResponse::Unhandled;
        }
        response.status = 403;
        return httplib::Server::HandlerResponse::Handled;
      });
  server.Get("/", [](const httplib::Request&, httplib::Response& response) {
    response.set_content(Page(), "text/html; charset=utf-8");
  });
  server.Get("/favicon.ico",
             [](const httplib::Request&, httplib::Response& response) { response.status = 204; });
  server.Get("/sequence", Answering([&view](const httplib::Request&, httplib::Response& response) {
               response.set_content(view.Description().dump(), "application/json");
             }));
  server.Get(
      "/picture", Answering([&view](const httplib::Request& request, httplib::Response& response) {
        const Bytes png = view.Picture(RequestOf(request));
        response.set_content(reinterpret_cast<const char*>(png.data()), png.size(), "image/png");
      }));
  server.Get("/pixel",
             Answering([&view](const httplib::Request& request, httplib::Response& response) {
               const ViewRequest wanted = RequestOf(request);
               response.set_content(
                   view.Pixel(wanted, NumberOf(request, "x"), NumberOf(request, "y")).dump(),
                   "application/json");
             }));
  is_ready("http://" + std::string(kLoopback) + ":" + std::to_string(port) + "/");
  if (!server.listen_after_bind()) {
    throw SystemError("cannot serve at {}:{}", kLoopback, port);
  }
}

}  // namespace pfseq
