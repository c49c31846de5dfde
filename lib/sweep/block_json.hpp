#pragma once

#include <nlohmann/json_fwd.hpp>

#include "esi/sweep/sweep_work.hpp"

namespace esi {

/// {"recording": 0, "round": 1, "stride": 16, "first": 8, "cells": [3, 4, 5]}
nlohmann::json to_json(const SweepBlock& block);

/// Throws an exception of nlohmann's for anything else.
SweepBlock block_from(const nlohmann::json& json);

}  // namespace esi
