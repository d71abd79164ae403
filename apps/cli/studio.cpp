// pelage studio: the page on which coats grow while one watches.

#include <spawn.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "command.h"
#include "interrupt.h"
#include "studio_server.h"
#include "usage.h"

extern char** environ;  // NOLINT: POSIX asks for this declaration

namespace pelage {

namespace {

struct StudioOptions {
  std::string page;
  int port = 0;
  bool no_open = false;
};

/// Beside the program, as it is built and as it is installed: PREFIX/bin/pelage and PREFIX/share/pelage/studio.
std::string own_page() {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  return (program.parent_path().parent_path() / "share" / "pelage" / "studio").string();
}

/// Whoever has no such program opens the link by hand.
void open_in_browser(std::string link) {
  std::string program = "xdg-open";
  std::array<char*, 3> arguments = {program.data(), link.data(), nullptr};
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int stream : {1, 2}) posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", 1, 0);
  pid_t process = 0;
  posix_spawnp(&process, program.c_str(), &silent, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&silent);
}

void studio(const StudioOptions& options) {
  StudioServer server(options.page.empty() ? own_page() : options.page, options.port);
  std::thread answering([&] { server.serve(); });
  std::printf("The studio is open at %s\nCtrl-C ends it.\n", server.link().c_str());
  std::fflush(stdout);
  if (!options.no_open) open_in_browser(server.link());
  catch_interrupts();
  constexpr auto pause = std::chrono::milliseconds(50);
  while (interrupt_signal() == 0) std::this_thread::sleep_for(pause);
  server.stop();
  answering.join();
}

}  // namespace

Command add_studio(CLI::App& parent) {
  auto options = std::make_shared<StudioOptions>();
  CLI::App* app = parent.add_subcommand(
      "studio",
      "Open the studio: a page in the browser on which coats grow while one watches\n"
      "The page is served to this machine alone, under a link that no one else knows. Nothing is sent anywhere.");
  constexpr int most_ports = 65535;
  app->add_option("--port", options->port, "Take this port (default: any that is free)")
      ->type_name("N")
      ->check(whole_number(1, most_ports));
  app->add_option("--page", options->page, "Folder of the page (default: the one that was built with the program)")
      ->type_name("DIR");
  app->add_flag("--no-open", options->no_open, "Only print the link");
  app->footer("Examples:\n  pelage studio\n  pelage studio --no-open --port 8080");
  return {app, [options] { studio(*options); }};
}

}  // namespace pelage
