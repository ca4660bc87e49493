// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "analysis/decode_fields.h"
#include "analysis/decode_summary.h"
#include "protocols/described/reading.h"

namespace navcal::analysis {

/// Decodes streams of a device that a file describes.
class DescribedDecoder {
 public:
  explicit DescribedDecoder(const protocols::described::Description& description);

  /// Runs the frames of a whole stream through `on_frame`. `next` gives the bytes, piece by piece, an empty piece
  /// at the end.
  DecodeSummary decode(const std::function<protocols::Bytes()>& next,
                       const std::function<void(const protocols::Frame&)>& on_frame) const;
  /// Writes the numbers of a frame under the names of their fields, in the units of the description; one that is
  /// absent is null. A frame with a value that cannot be is marked.
  void describe(FieldWriter& fields, const protocols::Frame& frame);

 private:
  struct Kind {
    protocols::FrameId id;
    protocols::described::FrameReader reader;
    std::vector<std::string> names;
    std::vector<double> values;
  };

  std::shared_ptr<const protocols::described::Plan> plan_;
  std::vector<Kind> kinds_;
};

}  // namespace navcal::analysis
