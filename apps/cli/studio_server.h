#pragma once
// The studio's engine on this machine, for a browser on it: HTTP on the loopback address, for those who hold the token
// (docs/studio-protocol.md, docs/studio.md).

#include <memory>
#include <string>

namespace pelage {

class StudioServer {
 public:
  /// `page`: a folder with index.html and all that belongs to it, read now. `port` 0: any that is free.
  /// Error(Fault::input) where there is no page, Error(Fault::output) for a port that is taken.
  StudioServer(const std::string& page, int port);
  ~StudioServer();

  /// The address of the page, with its token.
  std::string link() const;
  /// Answers until stop() is called, from another thread.
  void serve();
  void stop();

 private:
  struct File;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pelage
