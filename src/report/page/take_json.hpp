// Data of a take that the page needs besides its channels.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "kinemend/take.hpp"
#include "report/page/channels.hpp"
#include "report/page/stage.hpp"

namespace kinemend::page {

using Json = nlohmann::ordered_json;

/// Returns names, skeleton, gaps and stage. Frames count from 0.
Json take_json(const Take& before, const Take* after, const Channels& channels, const Stage& stage);

}  // namespace kinemend::page
