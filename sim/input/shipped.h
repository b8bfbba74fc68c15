// The files that come with the program, by name: scenes and studies.
#pragma once

#include <string>
#include <vector>

namespace hopmesh::input {

enum class Shipped { scene, study };

/// Where they are: beside an installed program, else in the tree that it was built from.
std::string shipped_folder(Shipped kind);
/// Their names, ascending.
std::vector<std::string> shipped_names(Shipped kind);
/// The first sentence of the comment that a shipped file opens with.
std::string about_shipped(const std::string& name, Shipped kind);
/// The path that a word on the command line means: a bare word is first the name of a shipped file; whoever
/// means a file of that name writes ./name. Throws InputError for a bare word that is neither.
std::string path_of(const std::string& word, Shipped kind);

} // namespace hopmesh::input
