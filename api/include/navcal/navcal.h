// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// All headers of the library.

#include <navcal/calibrate.h>
#include <navcal/diagnose.h>
#include <navcal/error.h>
#include <navcal/next_mission.h>
#include <navcal/pipeline.h>
#include <navcal/progress.h>
#include <navcal/recording.h>
#include <navcal/samples.h>
#include <navcal/simulate.h>
#include <navcal/version.h>
