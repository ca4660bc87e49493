// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "calib/calibrator.h"
#include "calib/correction.h"

/// The table of calibrators: one line each, naming the row that its unit defines. New ones go to the end.
#define NAVCAL_CALIBRATORS(ROW) \
  ROW(gyro)                     \
  ROW(gyro_b)                   \
  ROW(compass)                  \
  ROW(magnetometer)             \
  ROW(gps_compass)              \
  ROW(swing)                    \
  ROW(misalignment)             \
  ROW(compass_delay)            \
  ROW(course_delay)             \
  ROW(motor_current)            \
  ROW(reference_compass)        \
  ROW(reference_field)          \
  ROW(adaptive)

namespace navcal::calib {

namespace calibrator_rows {
#define NAVCAL_DECLARE_ROW(name) extern const CalibratorRow name;
NAVCAL_CALIBRATORS(NAVCAL_DECLARE_ROW)
#undef NAVCAL_DECLARE_ROW
}  // namespace calibrator_rows

namespace {

#define NAVCAL_ROW_ADDRESS(name) &calibrator_rows::name,
constexpr std::array kRows{NAVCAL_CALIBRATORS(NAVCAL_ROW_ADDRESS)};
#undef NAVCAL_ROW_ADDRESS
static_assert(kRows.size() >= kNamedCalibrators);

/// Copy of the table at run time, to which a ScopedCalibrator can add.
struct CalibratorTable {
  std::vector<const CalibratorRow*> rows;
  std::vector<Calibrator> calibrators;

  CalibratorTable() {
    for (const CalibratorRow* row : kRows) add(*row);
  }
  void add(const CalibratorRow& row) {
    calibrators.push_back(static_cast<Calibrator>(rows.size()));
    rows.push_back(&row);
  }
};

CalibratorTable& calibrator_table() {
  static CalibratorTable table;
  return table;
}

/// Marks in stored states that a name follows instead of a number.
constexpr auto kByName = static_cast<Calibrator>(255);

}  // namespace

std::span<const Calibrator> calibrators() { return calibrator_table().calibrators; }

const CalibratorRow& row_of(Calibrator calibrator) { return *calibrator_table().rows.at(index_of(calibrator)); }

std::string_view name_of(Calibrator calibrator) { return row_of(calibrator).name; }

std::optional<Calibrator> calibrator_named(std::string_view name) {
  const auto all = calibrators();
  const auto found = std::find_if(all.begin(), all.end(), [&](Calibrator one) { return name_of(one) == name; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

std::vector<NamedNumbers> values_of(const Correction& correction, Calibrator calibrator) {
  const CalibratorRow& row = row_of(calibrator);
  if (!row.place.has(correction, calibrator)) return {};
  if (row.values != nullptr) return row.values(correction);
  std::vector<NamedNumbers> values;
  const auto numbers = correction.added.of(calibrator);
  for (std::size_t i = 0; i < std::min(numbers.size(), row.value_names.size()); ++i)
    values.push_back({row.value_names[i], {numbers[i]}});
  return values;
}

void archive(Archive& archive, Calibrator& calibrator) {
  Calibrator number = index_of(calibrator) < kNamedCalibrators ? calibrator : kByName;
  archive(number);
  if (!archive.ok()) return;
  if (number == kByName) {
    std::string name = archive.saving() ? std::string(name_of(calibrator)) : std::string();
    archive(name);
    const auto found = calibrator_named(name);
    if (!found || index_of(*found) < kNamedCalibrators) return archive.fail();
    calibrator = *found;
  } else if (index_of(number) < kNamedCalibrators) {
    calibrator = number;
  } else {
    archive.fail();
  }
}

ScopedCalibrator::ScopedCalibrator(const CalibratorRow& row) { calibrator_table().add(row); }

ScopedCalibrator::~ScopedCalibrator() {
  calibrator_table().rows.pop_back();
  calibrator_table().calibrators.pop_back();
}

}  // namespace navcal::calib
