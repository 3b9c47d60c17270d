// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/process/interruption.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

namespace polhode::study::inline process {
namespace {

static_assert(std::atomic<bool>::is_always_lock_free);  // so that a signal handler may access it
static_assert(grace == 5);                              // the message states this number
static_assert(std::atomic<const char*>::is_always_lock_free);
std::atomic<bool> no_more_runs{false}, stop_runs{false};
std::atomic<const char*> last_words{nullptr};  // of a process that ends at once; null: it does not

constexpr std::array warnings = {SIGINT, SIGTERM, SIGUSR1, SIGXCPU};
std::array<struct sigaction, warnings.size()> former_warnings;
struct sigaction former_alarm;

void say(const char* text) { [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text)); }

void on_warning(int) {
  if (const char* message = last_words) {
    say(message);
    _exit(interrupted);
  }
  if (no_more_runs.exchange(true)) {
    stop_runs = true;
    return;
  }
  say("interrupted; runs under way have 5 s to finish, a second signal stops them\n");
  alarm(grace);
}

void on_alarm(int) { stop_runs = true; }

}  // namespace

Interruption::Interruption() {
  no_more_runs = stop_runs = false;
  last_words = nullptr;
  struct sigaction action = {};
  action.sa_flags = SA_RESTART;
  action.sa_handler = on_warning;
  for (std::size_t i = 0; i < warnings.size(); ++i) sigaction(warnings[i], &action, &former_warnings[i]);
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, &former_alarm);
}

Interruption::~Interruption() {
  alarm(0);
  for (std::size_t i = 0; i < warnings.size(); ++i) sigaction(warnings[i], &former_warnings[i], nullptr);
  sigaction(SIGALRM, &former_alarm, nullptr);
}

std::atomic<bool>& Interruption::no_more() { return no_more_runs; }
std::atomic<bool>& Interruption::stop() { return stop_runs; }
void Interruption::ends_at_once(const char* message) { last_words = message; }
void Interruption::runs_begin() { last_words = nullptr; }

}  // namespace polhode::study::process
