// SPDX-License-Identifier: Apache-2.0
// What `spa bench paper` says and writes. Schema of the JSON: ../formats/schemas/bench-paper.schema.json.
#pragma once

#include "paper_figures.h"
#include "paper_tables.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace spa::tools {

// What the experiments are held to, all of one run.
struct PaperBar {
    std::string name;
    double value = 0, limit = 0;
    bool at_least = true; // else at most
    [[nodiscard]] bool reached() const { return at_least ? value >= limit : value <= limit; }
};

struct PaperReport {
    std::string device, driver, backend;
    PaperTables tables;
    FigureOptions figure_options;
    std::vector<FigureError> figures;
    std::vector<PaperBar> bars;
};

// Those whose cells were measured.
std::vector<PaperBar> paper_bars(const PaperTables& tables);

nlohmann::ordered_json report_json(const PaperReport& report);
std::string report_text(const PaperReport& report);
// A title line, then one line a cell of the tables.
std::string report_csv(const PaperReport& report);

// Scripts for gnuplot: frames per second against vertices as in Fig. 7, one panel a number of samples; and
// speed against error.
struct PaperPlot {
    std::string name; // of the file, without extension
    std::string script;
};
std::vector<PaperPlot> paper_plots(const PaperReport& report);

} // namespace spa::tools
