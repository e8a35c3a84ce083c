/// Many pictures on one page, each scaled down.
#pragma once

#include "display/picture.h"
#include "ig_core/view.h"

namespace quadrig::display {

/// The mean of the pixels under each cell of `to`'s grid, by covered area, in linear light: a box filter. Alpha becomes
/// 255. For scaling down; `to` is at least 1x1 and not larger than `from` either way.
void scale_down(const FrameImage& from, const FrameImage& to);

/// A page of `columns` x `rows` thumbnails of one size, filled in reading order, with a dark gap round each.
class ContactSheet {
  public:
    ContactSheet(int columns, int rows, int thumbnail_width, int thumbnail_height, int gap = 4);
    /// Adds a picture of at least thumbnail size; a full page takes no more and answers false.
    bool add(const FrameImage& picture);
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] FrameImage image() { return page_.image(); }

  private:
    int columns_, rows_, thumbnail_width_, thumbnail_height_, gap_;
    int count_ = 0;
    Picture page_;
};

}  // namespace quadrig::display
