#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
namespace spa::tools { void write_batch_page(std::ostream& out, const nlohmann::ordered_json& report, const std::function<std::string(std::size_t)>& thumbnail); }
