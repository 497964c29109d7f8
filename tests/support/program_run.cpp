#include "tests/support/program_run.h"

#include <csignal>
#include <cstdint>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace cellcut::test {

ProgramRun::ProgramRun(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                       const std::string& before)
    : err_(folder / "err.txt") {
  std::vector<std::string> words;
  if (!before.empty()) words = {"/bin/sh", "-c", before + "; exec \"$@\"", "sh"};
  words.emplace_back(CELLCUT_PROGRAM);
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, (folder / "out.txt").c_str(), kNew, 0600);
  posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, err_.c_str(), kNew, 0600);
  const int failed = posix_spawn(&pid_, argv[0], &streams, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (failed != 0) throw std::runtime_error("cannot start " CELLCUT_PROGRAM);
}

ProgramRun::~ProgramRun() {
  if (pid_ == 0) return;
  send(SIGKILL);
  wait();
}

void ProgramRun::send(int signal) const {
  kill(pid_, signal);
}

bool ProgramRun::handles(int signal) const {
  std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
  for (std::string word; status >> word;) {
    if (word != "SigCgt:") continue;
    std::uint64_t caught = 0;  // bit n − 1 is signal n
    status >> std::hex >> caught;
    return (caught >> (signal - 1) & 1) != 0;
  }
  return false;
}

bool ProgramRun::runs() const {
  siginfo_t ended{};
  waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT);
  return ended.si_pid == 0;
}

ProgramEnd ProgramRun::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = 0;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0};
}

std::string ProgramRun::err() const {
  std::ifstream file(err_);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace cellcut::test
