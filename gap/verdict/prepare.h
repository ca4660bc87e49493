// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>

#include "gap/actuators/command_check.h"
#include "gap/inference/linearised.h"
#include "gap/nulls/bank_cache.h"
#include "gap/nulls/null_bank.h"
#include "gap/replay/replay.h"
#include "gap/verdict/diagnosis.h"
#include "gap/verdict/request.h"
#include "record/seen_recordings.h"

namespace navcal::gap {

/// A recording that is ready to be compared with simulated missions without a gap.
struct Prepared {
  Mission mission;
  std::unique_ptr<Replay> replay;
  Eigen::VectorXd at;  ///< parameters of the nominal vehicle with the turn-on biases of this recording
  Trajectory10Hz course;
  CommandCheck commands;
  NullBank bank;
  bool from_cache = false;
  std::string refusal;  ///< why the cache could not keep the bank; empty: it did, or was not to

  /// Whitened residuals of the recording as a function of the unknowns. The references are valid as long as
  /// this and `library`.
  [[nodiscard]] ResidualModel model(const Library& library, unsigned threads) const {
    return {*replay, library, bank.whitening, threads};
  }
};

/// The first step of a diagnosis: turns recordings into residuals, each with its null bank.
class Preparation {
 public:
  /// Keeps references to `request`, `library` and `progress`.
  Preparation(const Request& request, const Library& library, const Progress& progress, unsigned threads);

  /// Prepares one recording. nullptr: it cannot be diagnosed, and a remark in `answer` says why. Throws
  /// record::BadRecording, and std::invalid_argument when the recording shares readings with one that was
  /// prepared before it.
  [[nodiscard]] std::unique_ptr<Prepared> prepare(const std::filesystem::path& file, Diagnosis& answer);

 private:
  /// False for a repetition of a recording of the same kind, with a remark. Throws std::invalid_argument for any
  /// other stretch that two recordings share.
  bool is_new(const std::filesystem::path& file, Diagnosis& answer);
  /// Remarks on silent instruments and on commands; the facts of the first recording stand in `answer`.
  void remark_on(const Prepared& prepared, const std::string& name, Diagnosis& answer) const;
  /// Whether the commands, without reports, say what the vehicle did.
  [[nodiscard]] static bool can_obey(const CommandCheck& check, const std::string& name, Diagnosis& answer);
  /// Estimates the times of the fin orders where they were not recorded, and replays with them.
  void replay_orders(Prepared& prepared, const std::string& name, Diagnosis& answer) const;
  void find_bank(Prepared& prepared, const std::string& name, Diagnosis& answer);

  const Request& request_;
  const Library& library_;
  const Progress& progress_;
  unsigned threads_;
  BankCache cache_;
  record::SeenRecordings seen_;
  std::size_t given_ = 0;  ///< recordings: those to be diagnosed, then those held out
};

}  // namespace navcal::gap
