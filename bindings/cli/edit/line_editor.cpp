// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/edit/line_editor.hpp"

#include <histedit.h>

#include <clocale>
#include <cstdio>
#include <cstring>
#include <string>

namespace {

constexpr int most_lines = 1000;
constexpr wchar_t give_up_key = 3;  // Ctrl-C

struct Editor {
  AsperityEditHooks hooks{};
  EditLine* line = nullptr;
  History* history = nullptr;
  std::string prompt, text;
  bool given_up = false;
};

Editor& of(EditLine* line) {
  void* data = nullptr;
  el_get(line, EL_CLIENTDATA, &data);
  return *static_cast<Editor*>(data);
}

char* prompt_of(EditLine* line) { return of(line).prompt.data(); }

int read_character(EditLine* line, wchar_t* character) {
  Editor& editor = of(line);
  unsigned char byte = 0;
  for (;;) {
    const int got = editor.hooks.next_byte(editor.hooks.context, &byte);
    if (got == 0) return 0;
    if (got == 1) break;
    if (got == -2) {
      el_set(line, EL_PREP_TERM, 1);
      el_set(line, EL_REFRESH);
    } else if (got == -3) {
      el_resize(line);
    } else {
      *character = give_up_key;
      return 1;
    }
  }
  int more = byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : byte >= 0xC0 ? 1 : 0;
  auto code = static_cast<unsigned>(more == 0 ? byte : byte & (0x3FU >> more));
  for (; more > 0; --more) {
    if (editor.hooks.next_byte(editor.hooks.context, &byte) != 1) return 0;
    code = code << 6 | (byte & 0x3FU);
  }
  *character = static_cast<wchar_t>(code);
  return 1;
}

unsigned char give_up(EditLine* line, int) {
  of(line).given_up = true;
  return CC_NEWLINE;
}

unsigned char complete(EditLine* line, int) {
  Editor& editor = of(line);
  const LineInfo* info = el_line(line);
  const std::string text(info->buffer, info->lastchar);
  const AsperityEditAnswer answer = editor.hooks.complete(
      editor.hooks.context, text.c_str(), text.size(), static_cast<std::size_t>(info->cursor - info->buffer));
  if (answer.take_away > 0) el_deletestr(line, static_cast<int>(answer.take_away));
  if (answer.insert[0] != '\0' && el_insertstr(line, answer.insert) != 0) return CC_ERROR;
  if (answer.list[0] == '\0') return answer.insert[0] == '\0' ? CC_REFRESH_BEEP : CC_REFRESH;
  std::printf("\n%s", answer.list);
  std::fflush(stdout);
  return CC_REDISPLAY;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) void* asperity_edit_open(const AsperityEditHooks* hooks) {
  // Not the decimal point.
  if (std::setlocale(LC_CTYPE, "") == nullptr ||
      std::strstr(std::setlocale(LC_CTYPE, nullptr), "UTF-8") == nullptr)
    std::setlocale(LC_CTYPE, "C.UTF-8");
  auto* editor = new Editor;
  editor->hooks = *hooks;
  editor->line = el_init("asperity", stdin, stdout, stderr);
  if (editor->line == nullptr) {
    delete editor;
    return nullptr;
  }
  editor->history = history_init();
  HistEvent event{};
  history(editor->history, &event, H_SETSIZE, most_lines);
  history(editor->history, &event, H_SETUNIQUE, 1);
  EditLine* line = editor->line;
  el_set(line, EL_CLIENTDATA, editor);
  el_set(line, EL_EDITOR, "emacs");
  el_set(line, EL_PROMPT, prompt_of);
  el_set(line, EL_SIGNAL, 0);
  el_set(line, EL_HIST, history, editor->history);
  el_set(line, EL_GETCFN, read_character);
  el_set(line, EL_ADDFN, "asperity-complete", "offers what may come next", complete);
  el_set(line, EL_ADDFN, "asperity-give-up", "forgets the line", give_up);
  el_source(line, nullptr);  // the user's keys
  el_set(line, EL_BIND, "^I", "asperity-complete", nullptr);
  el_set(line, EL_BIND, "^C", "asperity-give-up", nullptr);
  el_set(line, EL_BIND, "^R", "em-inc-search-prev", nullptr);
  return editor;
}

__attribute__((visibility("default"))) int asperity_edit_read(void* pointer, const char* prompt,
                                                              const char** text) {
  Editor& editor = *static_cast<Editor*>(pointer);
  editor.prompt = prompt;
  editor.given_up = false;
  int count = 0;
  // Early: Ctrl-D must mean the end of input.
  el_set(editor.line, EL_PREP_TERM, 1);
  const char* got = el_gets(editor.line, &count);
  if (editor.given_up) {
    std::printf("\n");
    std::fflush(stdout);
    return -1;
  }
  if (got == nullptr || count <= 0) return 0;
  editor.text.assign(got, static_cast<std::size_t>(count));
  while (!editor.text.empty() && (editor.text.back() == '\n' || editor.text.back() == '\r'))
    editor.text.pop_back();
  *text = editor.text.c_str();
  return 1;
}

__attribute__((visibility("default"))) void asperity_edit_remember(void* pointer, const char* line) {
  Editor& editor = *static_cast<Editor*>(pointer);
  HistEvent event{};
  history(editor.history, &event, H_ENTER, line);
}

__attribute__((visibility("default"))) void asperity_edit_close(void* pointer) {
  auto* editor = static_cast<Editor*>(pointer);
  history_end(editor->history);
  el_end(editor->line);
  delete editor;
}

}  // extern "C"
