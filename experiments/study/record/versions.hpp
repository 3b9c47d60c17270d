// SPDX-License-Identifier: BSD-3-Clause
// Versions of stored results. manifest.json names both.
#pragma once

namespace polhode::study::inline record {

/// Part of the id of each run. Increase it when a change of the program changes the digits of results: stored runs are
/// then carried out again.
constexpr int results_version = 7;

/// Version of the tables of results.sqlite (PRAGMA user_version). Increase it when the tables, or the bytes under a
/// checksum, change. Metrics are columns of their own and are checked by name. Stores without a version count as 0.
constexpr int store_version = 2;

}  // namespace polhode::study::record
