// The result of a print check as an HTML page.
#pragma once

#include <string>

#include "app/reports/check_report.h"

namespace lamella {

/// Returns a self-contained HTML file without scripts: the verdict, a picture of the part, the table, and a
/// card for each of the worst places with the section of its layer. Its bytes depend only on the checked job.
/// Cuts layers again for the pictures.
std::string check_page(const CheckOutcome& outcome, const Job& job);

}  // namespace lamella
