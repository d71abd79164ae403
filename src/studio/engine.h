#pragma once
// What stands behind the page of the studio, wherever it runs: messages in, messages out (docs/studio-protocol.md).
// Knows no files, no sockets and no browser.

#include <atomic>
#include <memory>
#include <string>
#include <string_view>

namespace pelage {

class StudioEngine {
 public:
  /// `kind` is what `hello` tells of who carries the messages: "native" or "wasm".
  explicit StudioEngine(std::string kind);
  ~StudioEngine();

  /// The reply to a request, both as bytes. Never throws for what a request asks: faults are replies, too. One at a
  /// time.
  std::string handle(std::string_view request);

  /// Asks the request in progress to stop, from any thread: it is answered with Fault::cancelled, or with less work.
  void stop() { stop_ = true; }

 private:
  struct Parts;
  std::atomic<bool> stop_ = false;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pelage
