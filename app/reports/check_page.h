// What a print check found, as a page for a browser or a printer.
#pragma once

#include <string>

#include "app/reports/check_report.h"

namespace lamella {

/// One HTML file that needs no other and no script: the verdict, a picture of the part, the table, and a card
/// for each of the worst places with the section of its layer. Its bytes are decided by what is checked
/// alone. Layers are cut once more for the pictures.
std::string check_page(const CheckOutcome& outcome, const Job& job);

}  // namespace lamella
