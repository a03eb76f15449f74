#ifndef PETRICHOR_CLI_TEXTURE_CONTACT_SHEET_H
#define PETRICHOR_CLI_TEXTURE_CONTACT_SHEET_H

#include <string>
#include <vector>

#include "base/image.h"
#include "cli/report/drawing.h"

namespace petrichor::cli {

/// A sheet of pictures with words around them.
class ContactSheet {
public:
    ContactSheet(int width, int height);

    /// Places sRGB codes or linear colour (image.space decides; 1 or 3 channels) at a corner.
    void place(const Image& image, int x, int y);
    void text(int x, int y, const std::string& words, double size = 15.0, bool bold = false,
              Anchor anchor = Anchor::Start, const std::string& color = "#1c2024");

    /// Words and pictures as RGB bytes.
    Pixels pixels() const;

private:
    struct Placed {
        Image image;
        int x, y;
    };
    Drawing drawing_;
    std::vector<Placed> placed_;
};

}  // namespace petrichor::cli

#endif
