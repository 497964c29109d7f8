/// \file obj_lines.h
/// What OBJ and MTL files may say and tinyobjloader does not read, in words that it does.
///
/// Source: "Object Files (.obj)" and "Material Library File (.mtl)", Alias|Wavefront 1995; where they are silent, what
/// Blender's importer does.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cellcut {

/// Without blanks around it, and without a pair of quotes.
std::string_view unquoted(std::string_view name);

/// First word after blanks, taken off the front of `line` together with these. Empty if there is none.
std::string_view takeWord(std::string_view& line);

/// Blanks in place of every '\' at the end of a line and of that end, and of a byte order mark. Comments are left alone:
/// those end in the paths of folders now and then.
void joinContinuedLines(std::span<char> text);

struct ObjOutline {
  std::vector<std::string> libraries;  ///< what follows each "mtllib": one name with blanks, or several names
  bool hasSmoothingGroups = false;
  bool hasVertices = false;
  /// First vertex with a word that is no number.
  std::string unreadable;
  /// First other vertex, normal or texture coordinate that is not read as it stands: such words, NaN, infinity, too few.
  std::string doubtful;
};

/// Reads what must be known before the faces, and puts blanks in place of comments after faces.
/// \pre lines are joined
ObjOutline readOutline(std::span<char> obj);

struct PlainMtl {
  std::string text;
  std::vector<std::string> names;  ///< of the materials, which are called "0", "1", ... in the text
};

/// The library with three numbers wherever one stands for three (Ka, Kd, Ks, Ke, -o, -s, -t), numbers for names, which
/// tinyobjloader ends at a blank from version 2.0 rc13 on, and a Kd in every material: 1 below a map_Kd, else 0.8. A
/// dissolve with -halo is left out.
/// \pre lines are joined
PlainMtl plainMtl(std::string_view mtl);

}  // namespace cellcut
