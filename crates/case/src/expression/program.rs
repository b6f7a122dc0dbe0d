//! What an expression is compiled to: steps of a small stack machine.

/// Values that an evaluation may hold at once.
pub(super) const STACK: usize = 32;

/// One step. Operands are the values on top of the stack; the result takes their place.
#[derive(Debug, Clone, Copy)]
pub(super) enum Step {
    Constant(f64),
    Variable(usize),
    One(fn(f64) -> f64),
    Two(fn(f64, f64) -> f64),
    /// condition, then, else
    If,
}

/// Steps in their order, never holding more than `STACK` values.
#[derive(Debug, Clone)]
pub(super) struct Program {
    steps: Box<[Step]>,
}

impl Program {
    pub(super) fn constant(value: f64) -> Self {
        Self { steps: Box::new([Step::Constant(value)]) }
    }

    pub(super) fn eval(&self, variables: &[f64]) -> f64 {
        let mut stack = [0.0; STACK];
        let mut top = 0;
        for step in &self.steps {
            top = step.run(&mut stack, top, variables);
        }
        stack[0]
    }

    pub(super) fn variables(&self) -> impl Iterator<Item = usize> {
        self.steps.iter().filter_map(|step| match step {
            Step::Variable(v) => Some(*v),
            _ => None,
        })
    }

    pub(super) fn as_constant(&self) -> Option<f64> {
        match self.steps[..] {
            [Step::Constant(value)] => Some(value),
            _ => None,
        }
    }
}

impl Step {
    /// Runs the step on a stack that holds `top` values; how many it holds then.
    fn run(self, stack: &mut [f64; STACK], top: usize, variables: &[f64]) -> usize {
        match self {
            Self::Constant(value) => stack[top] = value,
            Self::Variable(v) => stack[top] = variables.get(v).copied().unwrap_or(f64::NAN),
            Self::One(f) => stack[top - 1] = f(stack[top - 1]),
            Self::Two(f) => stack[top - 2] = f(stack[top - 2], stack[top - 1]),
            Self::If => stack[top - 3] = if stack[top - 3] != 0.0 { stack[top - 2] } else { stack[top - 1] },
        }
        top + 1 - self.operands()
    }

    fn operands(self) -> usize {
        match self {
            Self::Constant(_) | Self::Variable(_) => 0,
            Self::One(_) => 1,
            Self::Two(_) => 2,
            Self::If => 3,
        }
    }
}

/// A program being written; steps on constants are carried out at once.
#[derive(Debug, Default)]
pub(super) struct Writer {
    steps: Vec<Step>,
    held: usize,
    most: usize,
}

impl Writer {
    pub(super) fn push(&mut self, step: Step) {
        self.held = self.held + 1 - step.operands();
        self.most = self.most.max(self.held);
        self.steps.push(step);
        self.fold(step.operands());
    }

    /// Replaces the last step by its value, if its operands are constants.
    fn fold(&mut self, operands: usize) {
        let Some(first) = self.steps.len().checked_sub(operands + 1) else { return };
        let constant = |step: &Step| matches!(step, Step::Constant(_));
        if operands == 0 || !self.steps[first..first + operands].iter().all(constant) {
            return;
        }
        let value = Program { steps: self.steps[first..].into() }.eval(&[]);
        self.steps.truncate(first);
        self.steps.push(Step::Constant(value));
    }

    /// The program; `None` if it needs a deeper stack than there is.
    pub(super) fn finish(self) -> Option<Program> {
        (self.most <= STACK).then(|| Program { steps: self.steps.into() })
    }
}
