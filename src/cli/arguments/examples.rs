//! What help says beside the arguments: where to begin, exit codes, examples.

pub(super) const BEGINNING: &str = "To begin: ribopt new > rib.toml && ribopt solve rib.toml";

pub(super) const EXIT_CODES: &str = "\
Exit codes:
  0  the best answer is certified and no backend holds a better feasible point
  1  an answer, but not certified
  2  the command line or the problem file is wrong
  3  infeasible
  4  unbounded or not attained
  5  a limit was reached or the run was interrupted
  6  the model gave a value that is no number";

pub(super) const EXAMPLES: &str = "\
Examples:
  ribs          most of the file (the default)
  rectangle, h-beam, i-section, tee, channel, angle, box, circle, tube, superellipse, polygon, polyline, general
                one kind of section each
  profile       dimensions that follow a B-spline along a line of ribs
  load-cases    arrays of moments and forces, one row per load case
  truss, frame, grillage
                structures: nodes, supports, loads, limits on stresses and displacements
  expressions   variables and expressions without any rib

Reference, in the folder docs of the source:
  expressions.md    names, operators, functions, arrays, sums over ribs and sections
  problem-file.md   every table and key of the file, CSV tables, --set
  section-kinds.md  dimensions and properties of every kind
  outputs.md        every file a run leaves, column by column, and result.json";

pub(super) const SECTION_EXAMPLES: &str = "\
Examples:
  ribopt section rib.toml support midspan --svg sections.svg
  ribopt section rib.toml --answer results/rib/result.json
  ribopt section --kind rectangle --dims b=0.2,h=0.5
  ribopt section --kind polyline --dims thickness=3 --points \"80 0; 0 0; 0 200; 80 200\" --svg channel.svg";
