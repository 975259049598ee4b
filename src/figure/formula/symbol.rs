//! Signs: the character a command stands for, and how much space it takes on either side.

/// The class of an atom, which decides the space around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    /// A letter, a digit.
    Ordinary,
    /// A sum, the name of a function.
    Operator,
    /// A plus.
    Binary,
    /// An equals sign.
    Relation,
    /// A left parenthesis.
    Open,
    /// A right parenthesis.
    Close,
    /// A comma.
    Punctuation,
    /// A fraction, something between growing parentheses.
    Inner,
}

/// Space between neighbours in eighteenths of an em; negative entries are dropped in scripts.
///
/// The table of *The `TeXbook`*, chapter 18, with rows and columns in the order of [`Class`].
const SPACES: [[i8; 8]; 8] = [
    [0, 3, -4, -5, 0, 0, 0, -3],
    [3, 3, 0, -5, 0, 0, 0, -3],
    [-4, -4, 0, 0, -4, 0, 0, -4],
    [-5, -5, 0, 0, -5, 0, 0, -5],
    [0, 0, 0, 0, 0, 0, 0, 0],
    [0, 3, -4, -5, 0, 0, 0, -3],
    [-3, -3, 0, -3, -3, -3, -3, -3],
    [-3, 3, -4, -5, -3, 0, -3, -3],
];

/// Space between two neighbours in em.
pub(super) fn space_between(left: Class, right: Class, in_script: bool) -> f64 {
    let entry = SPACES[left as usize][right as usize];
    if entry < 0 && in_script { 0.0 } else { f64::from(entry.abs()) / 18.0 }
}

/// The sign that stands for a character as typed, and its class; letters and digits are ordinary.
pub(super) fn typed(letter: char) -> (char, Class) {
    match letter {
        '-' => ('−', Class::Binary),
        '*' => ('∗', Class::Binary),
        ':' => (':', Class::Relation),
        _ => (letter, class_of(letter)),
    }
}

fn class_of(letter: char) -> Class {
    match letter {
        '+' | '−' | '±' | '∓' | '×' | '·' | '⋅' | '∘' | '∪' | '∩' | '⊕' | '⊗' | '∖' | '∧' | '∨' => {
            Class::Binary
        }
        '=' | '<' | '>' | '≤' | '≥' | '≠' | '≈' | '≡' | '∼' | '∈' | '∉' | '∋' | '⊂' | '⊆' | '⊃' | '≪'
        | '≫' | '→' | '←' | '↔' | '↦' | '⇒' | '⇔' | '⊥' | '∥' | '∝' | '≔' => {
            Class::Relation
        }
        '(' | '[' | '{' | '⟨' | '⌊' | '⌈' => Class::Open,
        ')' | ']' | '}' | '⟩' | '⌋' | '⌉' | '!' => Class::Close,
        ',' | ';' => Class::Punctuation,
        _ => Class::Ordinary,
    }
}

/// A big sign, and whether its limits stand above and below it in displayed formulas.
pub(super) fn big_operator(name: &str) -> Option<(char, bool)> {
    Some(match name {
        "sum" => ('∑', true),
        "prod" => ('∏', true),
        "bigcup" => ('⋃', true),
        "bigcap" => ('⋂', true),
        "int" => ('∫', false),
        "iint" => ('∬', false),
        "iiint" => ('∭', false),
        "oint" => ('∮', false),
        _ => return None,
    })
}

/// Whether the typed character is one of the big signs.
pub(super) fn typed_big_operator(letter: char) -> Option<bool> {
    match letter {
        '∑' | '∏' | '⋃' | '⋂' => Some(true),
        '∫' | '∬' | '∭' | '∮' => Some(false),
        _ => None,
    }
}

/// Whether the command is the name of a function, and whether its limits stand above and below it.
pub(super) fn function_name(name: &str) -> Option<bool> {
    match name {
        "max" | "min" | "sup" | "inf" | "lim" | "det" => Some(true),
        "sin" | "cos" | "tan" | "exp" | "log" | "ln" | "arg" | "dim" | "deg" | "div" | "grad" | "rank"
        | "span" | "supp" | "sign" | "diag" | "arctan" | "arccos" | "arcsin" | "sinh" | "cosh" => Some(false),
        _ => None,
    }
}

/// The accent a command puts over its argument, as a spacing character.
pub(super) fn accent(name: &str) -> Option<char> {
    Some(match name {
        "hat" => 'ˆ',
        "tilde" => '˜',
        "bar" => 'ˉ',
        "dot" => '˙',
        "ddot" => '¨',
        "vec" => '→',
        _ => return None,
    })
}

/// The space a command makes, in em.
pub(super) fn space(name: &str) -> Option<f64> {
    Some(match name {
        "," => 3.0 / 18.0,
        ":" => 4.0 / 18.0,
        ";" => 5.0 / 18.0,
        "!" => -3.0 / 18.0,
        " " => 0.25,
        "quad" => 1.0,
        "qquad" => 2.0,
        _ => return None,
    })
}

/// The sign that a command without arguments stands for, with its class.
pub(super) fn command(name: &str) -> Option<(char, Class)> {
    if let Some(letter) = greek(name) {
        return Some((letter, Class::Ordinary));
    }
    let sign = match name {
        "le" | "leq" => '≤',
        "ge" | "geq" => '≥',
        "ne" | "neq" => '≠',
        "ll" => '≪',
        "gg" => '≫',
        "approx" => '≈',
        "equiv" => '≡',
        "sim" => '∼',
        "propto" => '∝',
        "in" => '∈',
        "notin" => '∉',
        "ni" => '∋',
        "subset" => '⊂',
        "subseteq" => '⊆',
        "supset" => '⊃',
        "perp" => '⊥',
        "parallel" => '∥',
        "to" | "rightarrow" => '→',
        "leftarrow" => '←',
        "leftrightarrow" => '↔',
        "mapsto" => '↦',
        "Rightarrow" => '⇒',
        "Leftrightarrow" | "iff" => '⇔',
        "coloneq" => '≔',
        "cdot" => '⋅',
        "times" => '×',
        "pm" => '±',
        "mp" => '∓',
        "circ" => '∘',
        "cup" => '∪',
        "cap" => '∩',
        "oplus" => '⊕',
        "otimes" => '⊗',
        "setminus" => '∖',
        "wedge" => '∧',
        "vee" => '∨',
        "langle" => '⟨',
        "rangle" => '⟩',
        "lfloor" => '⌊',
        "rfloor" => '⌋',
        "lceil" => '⌈',
        "rceil" => '⌉',
        "{" | "lbrace" => '{',
        "}" | "rbrace" => '}',
        "|" | "Vert" => '‖',
        "vert" => '|',
        "prime" => '′',
        "infty" => '∞',
        "partial" => '∂',
        "nabla" => '∇',
        "ell" => 'ℓ',
        "emptyset" => '∅',
        "forall" => '∀',
        "exists" => '∃',
        "ldots" | "dots" => '…',
        "cdots" => '⋯',
        "vdots" => '⋮',
        "ddots" => '⋱',
        "degree" => '°',
        "%" => '%',
        "#" => '#',
        "&" => '&',
        "_" => '_',
        "$" => '$',
        _ => return None,
    };
    let class = match sign {
        '…' | '⋯' => Class::Inner,
        _ => class_of(sign),
    };
    Some((sign, class))
}

fn greek(name: &str) -> Option<char> {
    Some(match name {
        "alpha" => 'α',
        "beta" => 'β',
        "gamma" => 'γ',
        "delta" => 'δ',
        "epsilon" => 'ϵ',
        "varepsilon" => 'ε',
        "zeta" => 'ζ',
        "eta" => 'η',
        "theta" => 'θ',
        "vartheta" => 'ϑ',
        "iota" => 'ι',
        "kappa" => 'κ',
        "varkappa" => 'ϰ',
        "lambda" => 'λ',
        "mu" => 'μ',
        "nu" => 'ν',
        "xi" => 'ξ',
        "omicron" => 'ο',
        "pi" => 'π',
        "varpi" => 'ϖ',
        "rho" => 'ρ',
        "varrho" => 'ϱ',
        "sigma" => 'σ',
        "varsigma" => 'ς',
        "tau" => 'τ',
        "upsilon" => 'υ',
        "phi" => 'ϕ',
        "varphi" => 'φ',
        "chi" => 'χ',
        "psi" => 'ψ',
        "omega" => 'ω',
        "Gamma" => 'Γ',
        "Delta" => 'Δ',
        "Theta" => 'Θ',
        "Lambda" => 'Λ',
        "Xi" => 'Ξ',
        "Pi" => 'Π',
        "Sigma" => 'Σ',
        "Upsilon" => 'Υ',
        "Phi" => 'Φ',
        "Psi" => 'Ψ',
        "Omega" => 'Ω',
        _ => return None,
    })
}
