#include "studio_server.h"

#include <httplib.h>

#include <array>
#include <filesystem>
#include <map>
#include <mutex>
#include <random>

#include "io/file_bytes.h"
#include "pelage/error.h"
#include "studio/engine.h"

namespace pelage {

/// Of the page.
struct StudioServer::File {
  std::string type, bytes;
};

namespace {

constexpr const char* host = "127.0.0.1";
/// A mesh of five million triangles; more would not grow in a studio anyway.
constexpr std::size_t largest_request = 256 << 20;
/// Browsers keep six connections open, each of which waits in a thread of its own.
constexpr std::size_t threads = 16;
constexpr const char* message_type = "application/octet-stream";

std::string type_of(const std::string& extension) {
  static const std::map<std::string, std::string> types = {{".html", "text/html; charset=utf-8"},
                                                           {".js", "text/javascript; charset=utf-8"},
                                                           {".css", "text/css; charset=utf-8"},
                                                           {".json", "application/json"},
                                                           {".svg", "image/svg+xml"},
                                                           {".png", "image/png"},
                                                           {".jpg", "image/jpeg"},
                                                           {".webp", "image/webp"},
                                                           {".wasm", "application/wasm"},
                                                           {".woff2", "font/woff2"},
                                                           {".ico", "image/x-icon"}};
  const auto found = types.find(extension);
  return found == types.end() ? message_type : found->second;
}

/// All files of a folder by their paths in it: what is not among them, no request can reach.
template <class File>
std::map<std::string, File> read_page(const std::string& folder) {
  std::map<std::string, File> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none))
    if (entry.is_regular_file())
      files["/" + std::filesystem::relative(entry.path(), folder).generic_string()] = {
          type_of(lower_extension(entry.path().string())), read_file(entry.path().string())};
  if (!files.contains("/index.html"))
    throw Error(Fault::input, folder +
                                  ": there is no page of the studio; build it (docs/studio.md), or name its folder "
                                  "with --page");
  return files;
}

std::string make_token() {
  std::random_device source;
  std::string token;
  for (int i = 0; i < 4; ++i) {
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x", source());
    token += digits.data();
  }
  return token;
}

/// In a time that does not tell how much of it is right.
bool same_token(const std::string& a, const std::string& b) {
  unsigned different = a.size() != b.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    different |= static_cast<unsigned>(a[i]) ^ static_cast<unsigned>(b[i]);
  return different == 0;
}

}  // namespace

struct StudioServer::Parts {
  std::map<std::string, File> page;
  std::string token = make_token();
  int port = 0;
  std::mutex one_at_a_time;
  StudioEngine engine{"native"};
  httplib::Server server;

  /// Of this machine and this page: others that a browser visits know neither the port's name nor the token.
  bool from_here(const httplib::Request& request) const {
    const std::string own = std::string(host) + ":" + std::to_string(port), named = "localhost:" + std::to_string(port);
    const std::string asked = request.get_header_value("Host"), origin = request.get_header_value("Origin");
    return (asked == own || asked == named) &&
           (origin.empty() || origin == "http://" + own || origin == "http://" + named);
  }
  bool allowed(const httplib::Request& request, httplib::Response& response) const {
    if (same_token(request.get_header_value("X-Pelage-Token"), token)) return true;
    response.status = 403;
    response.set_content("the link of the page has another token\n", "text/plain");
    return false;
  }
  void show_page(const httplib::Request& request, httplib::Response& response) const {
    const auto file = page.find(request.path == "/" ? "/index.html" : request.path);
    if (file == page.end()) {
      response.status = 404;
      response.set_content("there is no such page\n", "text/plain");
      return;
    }
    // By a provider, as the library compresses contents, as well as it can: seconds, for a way inside this machine.
    const std::string& bytes = file->second.bytes;
    response.set_content_provider(bytes.size(), file->second.type.c_str(),
                                  [&bytes](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                    return sink.write(bytes.data() + offset, length);
                                  });
  }
  void answer(const httplib::Request& request, httplib::Response& response) {
    if (!allowed(request, response)) return;
    const std::lock_guard lock(one_at_a_time);
    response.set_content(engine.handle(request.body), message_type);
  }
  void route();
};

void StudioServer::Parts::route() {
  server.new_task_queue = [] { return new httplib::ThreadPool(threads); };
  server.set_payload_max_length(largest_request);
  server.set_tcp_nodelay(true);
  // Not SO_REUSEPORT, which the library sets: two programs would share a port, and each get some of the requests.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_default_headers(
      {{"Content-Security-Policy",
        "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; media-src 'self' blob:; "
        "worker-src 'self' blob:; script-src 'self' 'wasm-unsafe-eval'; object-src 'none'; base-uri 'none'; "
        "form-action 'none'; frame-ancestors 'self'"},
       {"X-Content-Type-Options", "nosniff"},
       {"Referrer-Policy", "no-referrer"},
       {"Cross-Origin-Resource-Policy", "same-origin"},
       {"Cache-Control", "no-store"}});
  server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    if (from_here(request)) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    response.set_content("the studio answers its own page on this machine only\n", "text/plain");
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Post("/api", [this](const httplib::Request& request, httplib::Response& r) { answer(request, r); });
  server.Post("/stop", [this](const httplib::Request& request, httplib::Response& r) {
    if (!allowed(request, r)) return;
    engine.stop();
    r.set_content("", message_type);
  });
  server.Get(".*", [this](const httplib::Request& request, httplib::Response& r) { show_page(request, r); });
}

StudioServer::StudioServer(const std::string& page, int port) : parts_(std::make_unique<Parts>()) {
  parts_->page = read_page<File>(page);
  parts_->route();
  if (port == 0)
    parts_->port = parts_->server.bind_to_any_port(host);
  else if (parts_->server.bind_to_port(host, port))
    parts_->port = port;
  if (parts_->port <= 0)
    throw Error(Fault::output, "port " + std::to_string(port) + " cannot be used; leave --port out for a free one");
}

StudioServer::~StudioServer() = default;

std::string StudioServer::link() const {
  return std::string("http://") + host + ":" + std::to_string(parts_->port) + "/#token=" + parts_->token;
}

void StudioServer::serve() { parts_->server.listen_after_bind(); }

void StudioServer::stop() {
  parts_->engine.stop();
  parts_->server.stop();
}

}  // namespace pelage
