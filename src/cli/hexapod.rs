use clap::Args; #[derive(Args)] pub struct Hexapod{} 
