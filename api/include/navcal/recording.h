// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/export.h>
#include <navcal/samples.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace navcal::api {

/// A recording (capture or log) that is played through the pipeline, in constant memory. The samples are those of
/// `navcal replay`, bit for bit and in its order: for a log, those that the daemon made. Satellites in view,
/// events and orders are not among them. An object may be used by one thread at a time.
///
///     for (const navcal::api::Sample& sample : navcal::api::Recording("dive.mcap")) ...
class NAVCAL_API Recording {
 public:
  /// Opens `file`, told apart by its content. `config` names a configuration of navcald to use instead of the
  /// recording's own; empty: none. Throws Error (bad_input).
  explicit Recording(const std::filesystem::path& file, const std::filesystem::path& config = {});
  ~Recording();
  Recording(Recording&& other) noexcept;             ///< Takes over; `other` can only be destroyed or assigned to.
  Recording& operator=(Recording&& other) noexcept;  ///< Takes over; `other` can only be destroyed or assigned to.

  /// Ports of the configuration in use, in the order that Sample::port counts.
  [[nodiscard]] const std::vector<Port>& ports() const;
  /// The configuration in use as the text of a file, complete and to the last bit: for Pipeline::from_text().
  /// A capture does not say where its ports were: their place is "FILE:PORT" then, which nothing opens.
  [[nodiscard]] std::string configuration() const;
  /// The next sample; nullopt at the end. Throws Error (bad_input) for content that cannot be read over.
  std::optional<Sample> next();
  /// Share of the file that has been read, 0 to 1.
  [[nodiscard]] double progress() const;
  /// Irregularities so far, each with the file: "dive.mcap: unfinished: 12 bytes after the last whole record".
  [[nodiscard]] const std::vector<std::string>& remarks() const;

  /// Input iterator over the samples that have not been read yet. Its increment throws what next() throws.
  class Iterator {
   public:
    using value_type = Sample;               ///< what it gives
    using difference_type = std::ptrdiff_t;  ///< of input iterators

    /// Reads the first sample.
    explicit Iterator(Recording& recording) : recording_(&recording), sample_(recording.next()) {}
    /// The current sample, until the next increment.
    [[nodiscard]] const Sample& operator*() const { return *sample_; }
    /// A member of the current sample.
    [[nodiscard]] const Sample* operator->() const { return &*sample_; }
    /// Reads the next sample.
    Iterator& operator++() {
      sample_ = recording_->next();
      return *this;
    }
    /// Reads the next sample.
    void operator++(int) { ++*this; }
    /// Whether there are no more samples.
    [[nodiscard]] bool operator==(std::default_sentinel_t /*end*/) const { return !sample_; }

   private:
    Recording* recording_;
    std::optional<Sample> sample_;
  };
  /// Begins where the last call of next() ended. Throws what next() throws.
  [[nodiscard]] Iterator begin() { return Iterator(*this); }
  /// The end of the recording.
  [[nodiscard]] std::default_sentinel_t end() const { return {}; }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace navcal::api
