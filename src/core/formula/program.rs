//! The program that a formula becomes: operations in postfix notation on a small stack.

use crate::core::formula::series;

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unary {
    Negate,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Log,
    Log10,
    Sqrt,
    Cbrt,
    Abs,
    Sign,
    Floor,
    Ceil,
    Step,
}

/// A function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Min,
    Max,
    Atan2,
    Hypot,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Operation {
    Constant(f64),
    Variable(usize),
    Unary(Unary),
    Binary(Binary),
}

/// Stack that stands on the machine's stack for ordinary formulas, and for the deepest that the parser lets through.
const SMALL: usize = 16;
const LARGE: usize = 512;

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Program {
    operations: Vec<Operation>,
    /// Operands on the stack after the last operation, and the most there ever are.
    height: usize,
    depth: usize,
}

impl Program {
    /// Number of operations; where the next operand will start.
    pub(super) fn len(&self) -> usize {
        self.operations.len()
    }

    pub(super) fn push(&mut self, operation: Operation) {
        match operation {
            Operation::Constant(_) | Operation::Variable(_) => self.height += 1,
            Operation::Unary(_) => {}
            Operation::Binary(_) => self.height -= 1,
        }
        self.depth = self.depth.max(self.height);
        self.operations.push(operation);
    }

    /// Appends a function whose arguments start at operation `start`; of constants it is computed at once.
    pub(super) fn apply(&mut self, function: Operation, start: usize) {
        let folded = match (function, &self.operations[start..]) {
            (Operation::Unary(f), &[Operation::Constant(a)]) => f.of(a),
            (Operation::Binary(f), &[Operation::Constant(a), Operation::Constant(b)]) => f.of(a, b),
            _ => return self.push(function),
        };
        self.height -= self.operations.len() - start;
        self.operations.truncate(start);
        self.push(Operation::Constant(folded));
    }

    pub(super) fn value(&self, at: &[f64]) -> f64 {
        if self.depth <= SMALL { self.run(at, &mut [0.0; SMALL]) } else { self.run(at, &mut [0.0; LARGE]) }
    }

    fn run(&self, at: &[f64], stack: &mut [f64]) -> f64 {
        let mut top = 0;
        for operation in &self.operations {
            match *operation {
                Operation::Unary(function) => stack[top - 1] = function.of(stack[top - 1]),
                Operation::Binary(function) => {
                    top -= 1;
                    stack[top - 1] = function.of(stack[top - 1], stack[top]);
                }
                Operation::Constant(value) => {
                    stack[top] = value;
                    top += 1;
                }
                Operation::Variable(index) => {
                    stack[top] = at.get(index).copied().unwrap_or(f64::NAN);
                    top += 1;
                }
            }
        }
        stack[0]
    }

    /// Taylor coefficients `0 … count` with respect to `variable`.
    pub(super) fn series(&self, at: &[f64], variable: usize, count: usize) -> Vec<f64> {
        let length = count + 1;
        let mut stack = vec![0.0; length * self.depth.max(1)];
        let mut spare = vec![0.0; 2 * length];
        let mut top = 0;
        for operation in &self.operations {
            match *operation {
                Operation::Unary(function) => {
                    series::unary(function, &mut stack[(top - 1) * length..top * length], &mut spare);
                }
                Operation::Binary(function) => {
                    top -= 1;
                    let (left, right) = stack[(top - 1) * length..(top + 1) * length].split_at_mut(length);
                    series::binary(function, left, right, &mut spare);
                }
                Operation::Constant(value) => {
                    stack[top * length..(top + 1) * length].fill(0.0);
                    stack[top * length] = value;
                    top += 1;
                }
                Operation::Variable(index) => {
                    stack[top * length..(top + 1) * length].fill(0.0);
                    stack[top * length] = at.get(index).copied().unwrap_or(f64::NAN);
                    if index == variable && count > 0 {
                        stack[top * length + 1] = 1.0;
                    }
                    top += 1;
                }
            }
        }
        stack.truncate(length);
        stack
    }
}

impl Unary {
    pub(super) fn of(self, a: f64) -> f64 {
        match self {
            Self::Negate => -a,
            Self::Sin => a.sin(),
            Self::Cos => a.cos(),
            Self::Tan => a.tan(),
            Self::Asin => a.asin(),
            Self::Acos => a.acos(),
            Self::Atan => a.atan(),
            Self::Sinh => a.sinh(),
            Self::Cosh => a.cosh(),
            Self::Tanh => a.tanh(),
            Self::Exp => a.exp(),
            Self::Log => a.ln(),
            Self::Log10 => a.log10(),
            Self::Sqrt => a.sqrt(),
            Self::Cbrt => a.cbrt(),
            Self::Abs => a.abs(),
            // `signum` gives ±1 for ±0.
            Self::Sign if a == 0.0 => 0.0,
            Self::Sign => a.signum(),
            Self::Floor => a.floor(),
            Self::Ceil => a.ceil(),
            Self::Step if a.is_nan() => a,
            Self::Step => f64::from(u8::from(a >= 0.0)),
        }
    }
}

impl Binary {
    pub(super) fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Power => power(a, b),
            // `f64::min` would drop a NaN.
            Self::Min => {
                if a.is_nan() || a <= b {
                    a
                } else {
                    b
                }
            }
            Self::Max => {
                if a.is_nan() || a >= b {
                    a
                } else {
                    b
                }
            }
            Self::Atan2 => a.atan2(b),
            Self::Hypot => a.hypot(b),
        }
    }
}

/// Exponents that multiplication serves faster than logarithms, without losing digits.
const SMALL_EXPONENT: f64 = 8.0;

pub(super) fn power(base: f64, exponent: f64) -> f64 {
    if exponent.abs() <= SMALL_EXPONENT && exponent.fract() == 0.0 {
        base.powi(exponent as i32)
    } else {
        base.powf(exponent)
    }
}
