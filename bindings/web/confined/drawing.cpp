// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/drawing.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>

#include "bindings/web/confined/confined_process.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/temporary_folder.hpp"

namespace asperity::web {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr auto patience = std::chrono::seconds(30);

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() < 64 && name[0] != '.' && name != "script" && name != "picture" &&
         std::ranges::all_of(
             name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; });
}

GnuplotResult ask(int socket, std::string_view script, std::span<const GnuplotData> data) {
  static std::mutex one_at_a_time;
  std::vector<std::string_view> texts{script};
  for (const GnuplotData& item : data) texts.insert(texts.end(), {item.name, item.bytes});
  const std::lock_guard lock(one_at_a_time);
  const auto answer = send_frame(socket, texts) ? receive_frame(socket, most_bytes) : std::nullopt;
  if (!answer || answer->size() != 3)
    throw Error(ErrorCode::bad_state, "the picture was not drawn: the server that draws it gave no answer",
                "a picture may have at most 64 MiB of data");
  if (!(*answer)[0].empty()) throw Error(ErrorCode::bad_state, (*answer)[0]);
  return {(*answer)[1], (*answer)[2]};
}

GnuplotResult draw(const std::vector<std::string>& request, const std::vector<std::string>& barriers,
                   const std::atomic<bool>& given_up) {
  const TemporaryFolder folder("picture");
  write_atomically(folder.path() / "script", script_for_file(request[0]));
  for (std::size_t k = 1; k + 1 < request.size(); k += 2) {
    if (!is_plain_name(request[k]))
      throw Error(ErrorCode::not_permitted, "data of a picture have a name that is none");
    write_atomically(folder.path() / request[k], request[k + 1]);
  }
  ConfinedRequest work{.work = Work::draw, .confinement = {}};
  work.confinement.as = Confined::drawing;
  work.confinement.processor_seconds = 20;
  // Landlock and the own root each restrict files. With Landlock, the own root is optional, because gnuplot
  // on some systems needs files outside it.
  const bool landlock = std::ranges::any_of(
      barriers, [](const std::string& barrier) { return barrier.starts_with("Landlock"); });
  for (const std::string& barrier : barriers)
    if (!landlock || barrier != own_root_barrier) work.barriers.push_back(barrier);
  const Finished done = run_confined(work, folder.path().string(), patience, std::size_t{1} << 16, &given_up);
  std::string picture = read_plain_file(folder.path(), "picture", most_bytes).value_or("");
  if (done.status != 0 || picture.empty())
    throw Error(ErrorCode::bad_state,
                done.status == 127
                    ? "charts and pictures are drawn by gnuplot, which is not installed"
                    : "gnuplot drew no picture: " + done.error + (done.late ? "it took too long" : ""));
  return {std::move(picture), done.error};
}

}  // namespace

void draw_by_server(int socket) {
  draw_pictures_by([socket](std::string_view script, std::span<const GnuplotData> data) {
    return ask(socket, script, data);
  });
}

bool answer_drawing(int socket, const std::vector<std::string>& barriers, const std::atomic<bool>& given_up) {
  const auto request = receive_frame(socket, most_bytes);
  if (!request || request->empty() || request->size() % 2 == 0) return false;
  try {
    const GnuplotResult drawn = draw(*request, barriers, given_up);
    const std::string_view answer[] = {"", drawn.picture, drawn.messages};
    return send_frame(socket, answer);
  } catch (const std::exception& error) {
    const std::string_view answer[] = {error.what(), "", ""};
    return send_frame(socket, answer);
  }
}

}  // namespace asperity::web
