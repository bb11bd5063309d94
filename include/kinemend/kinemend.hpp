// The whole stable API in one header: read, clean, fill, check, compare, report, stream and write
// takes.
#pragma once

#include "kinemend/check.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "kinemend/live.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/metrics.hpp"
#include "kinemend/report.hpp"
#include "kinemend/take.hpp"
