// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/packed_bodies.hpp"
#include "piola/simulation/wall_time_limit.hpp"
#include "run_support.hpp"
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace piola::app {

/// Monitors the set-up before the first step, from its construction on. A line on stderr names the running stage: on a
/// terminal from the third second on, elsewhere only for packings. A stop signal (catch_stop_signals()) and the end of
/// the wall time end set-up: packings are stopped after a sweep and stored, any other stage ends the program with exit
/// code 4. Only packings write files before the first step, each as a whole, so that no incomplete file remains.
class SetUpWatch {
 public:
  using Clock = std::chrono::steady_clock;
  struct Limits {
    double wall_time = WallLimit::none;                             ///< since the start of the program [s]
    double most_packing = std::numeric_limits<double>::infinity();  ///< packings that take longer are accepted
                                                                    ///< unfinished [s]
    bool quiet = false;
  };
  SetUpWatch(std::string stage, Limits const& limits);
  ~SetUpWatch();
  SetUpWatch(SetUpWatch const&) = delete;
  SetUpWatch& operator=(SetUpWatch const&) = delete;

  /// Enters the next stage that may take long, such as "building the simulation". Throws SetUpStopped if a signal has
  /// come.
  void enter(std::string stage);
  /// For read_case: called after each sweep of a packing.
  AfterSweep operator()(std::string const& body, double done);
  /// Unfinished packings that were accepted, one sentence each, and the estimated time to finish them [s].
  std::vector<std::string> const& left_out() const { return left_out_; }
  double seconds_left_out() const { return seconds_left_out_; }

 private:
  void watch();
  void say_stage();
  void end_if_due();
  bool packs() const;

  Limits limits_;
  WallLimit wall_;
  bool terminal_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::string stage_;
  Clock::time_point stage_began_;
  StatusLine line_;
  std::string body_;  ///< being packed
  Clock::time_point packing_began_, last_sweep_;
  double slowest_sweep_ = 0;  ///< [s]; 0: no packing
  std::vector<std::string> left_out_;
  double seconds_left_out_ = 0;
  std::thread thread_;
};

/// Input of the set-up.
struct SetUpFrom {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::filesystem::path unfinished;  ///< see ReadLimits
  bool of_results = false;           ///< see ReadLimits
  bool pictures = true;              ///< false: no pictures
};

/// Reads a case and builds it under a watch; afterwards signals request a stop. Throws as read_case() and build() do,
/// and SetUpStopped.
Simulation set_up(SetUpFrom const& from, SetUpWatch::Limits const& limits);

}  // namespace piola::app
