; From route_search.cpp, SHA-256 9b03759c4264b815be9d4e79cd04d7b70b40d4a17136c2f901190ab407f1a20b, by tools/native.py. Do not edit.

%struct.Point.7 = type { <8 x double>, <8 x double>, <8 x double> }
%struct.Point = type { <16 x float>, <16 x float>, <16 x float> }
%struct.Frame = type { [9 x <16 x float>], [3 x <16 x float>] }
%struct.Motion = type { [17 x float], [17 x float], [136 x float], [136 x float] }
%struct.Joint = type { [9 x float], [3 x float], float }
%struct.Sphere = type { float, float, float, float }
%struct.Object = type { [9 x float], [3 x float], [3 x float], float, float, float }
%struct.LinkPair = type { i64, i64, i64, i64 }
%struct.Part = type { [3 x float], [3 x float], float, float }
%struct.PartPair = type { i64, i64 }
%struct.Frame.3 = type { [9 x <8 x double>], [3 x <8 x double>] }
%struct.Motion.2 = type { [17 x double], [17 x double], [136 x double], [136 x double] }
%struct.Piece = type { double, double }
%struct.Joint.6 = type { [9 x double], [3 x double], double }
%struct.Sphere.8 = type { double, double, double, double }
%struct.Object.9 = type { [9 x double], [3 x double], [3 x double], double, double, double }
%struct.Part.10 = type { [3 x double], [3 x double], double, double }
%struct.Piece.11 = type { double, double }
%struct.Errors = type { i64, [24 x i64], [24 x <8 x double>], [24 x <8 x double>], [24 x [64 x <8 x double>]], [24 x <8 x double>] }
%struct.Constraint = type { i64, i64, i64, [9 x double], [3 x double], [9 x double], [3 x double], [3 x double], double }
%struct.SpanPiece = type { i64, float, float }
%struct.Contact = type { %struct.SpanPiece, i64, double }
%struct.Tree = type { ptr, ptr, i64 }
%struct.Random = type { i64 }

$_ZN6Errors8evaluateILb0EEEvRK8ManifoldPKDv8_d = comdat any

$_ZN6Errors8evaluateILb1EEEvRK8ManifoldPKDv8_d = comdat any

@__const._ZN6Errors8evaluateILb1EEEvRK8ManifoldPKDv8_d.unit = private unnamed_addr constant [3 x %struct.Point.7] [%struct.Point.7 { <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, <8 x double> zeroinitializer, <8 x double> zeroinitializer }, %struct.Point.7 { <8 x double> zeroinitializer, <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, <8 x double> zeroinitializer }, %struct.Point.7 { <8 x double> zeroinitializer, <8 x double> zeroinitializer, <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00> }], align 64

define void @check_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, i64 noundef %3, float noundef %4, float noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = icmp sgt i64 %3, 0
  br i1 %8, label %10, label %9

9:
  ret void

10:
  %11 = phi i64 [ %19, %10 ], [ 0, %7 ]
  %12 = load i64, ptr %0, align 8
  %13 = mul nsw i64 %12, %11
  %14 = getelementptr inbounds float, ptr %1, i64 %13
  %15 = getelementptr inbounds float, ptr %2, i64 %13
  %16 = tail call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef %14, ptr noundef %15, float noundef %4, float noundef %5)
  %17 = zext i1 %16 to i8
  %18 = getelementptr inbounds i8, ptr %6, i64 %11
  store i8 %17, ptr %18, align 1
  %19 = add nuw nsw i64 %11, 1
  %20 = icmp eq i64 %19, %3
  br i1 %20, label %9, label %10
}

declare void @llvm.lifetime.start.p0(i64 immarg, ptr nocapture)

define internal fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, float noundef %3, float noundef %4) unnamed_addr {
  %6 = alloca [192 x %struct.Point], align 64
  %7 = alloca [2 x i64], align 16
  %8 = alloca [9 x <16 x float>], align 64
  %9 = alloca [16 x <16 x float>], align 64
  %10 = alloca [17 x <16 x float>], align 64
  %11 = alloca [136 x <16 x float>], align 64
  %12 = alloca [17 x %struct.Frame], align 64
  %13 = alloca %struct.Motion, align 4
  call void @llvm.lifetime.start.p0(i64 1224, ptr nonnull %13)
  %14 = getelementptr inbounds i8, ptr %13, i64 136
  %15 = load i64, ptr %0, align 8
  %16 = icmp slt i64 %15, 0
  br i1 %16, label %21, label %17

17:
  %18 = getelementptr inbounds i8, ptr %0, i64 112
  %19 = icmp eq i64 %15, 0
  %20 = load ptr, ptr %18, align 8
  br label %29

21:
  %22 = getelementptr inbounds i8, ptr %0, i64 16
  %23 = load i64, ptr %22, align 8
  %24 = icmp sgt i64 %23, 0
  br i1 %24, label %25, label %75

25:
  %26 = getelementptr inbounds i8, ptr %0, i64 120
  %27 = icmp sgt i64 %15, 0
  %28 = load ptr, ptr %26, align 8
  br label %52

29:
  %30 = phi i64 [ 0, %17 ], [ %50, %47 ]
  %31 = mul nuw nsw i64 %30, %15
  %32 = getelementptr inbounds float, ptr %20, i64 %31
  br i1 %19, label %47, label %33

33:
  %34 = phi i64 [ %45, %33 ], [ 0, %29 ]
  %35 = phi float [ %44, %33 ], [ 0.000000e+00, %29 ]
  %36 = getelementptr inbounds float, ptr %32, i64 %34
  %37 = load float, ptr %36, align 4
  %38 = getelementptr inbounds float, ptr %2, i64 %34
  %39 = load float, ptr %38, align 4
  %40 = fcmp contract olt float %39, 0.000000e+00
  %41 = fneg contract float %39
  %42 = select contract i1 %40, float %41, float %39
  %43 = fmul contract float %37, %42
  %44 = fadd contract float %35, %43
  %45 = add nuw nsw i64 %34, 1
  %46 = icmp eq i64 %45, %15
  br i1 %46, label %47, label %33

47:
  %48 = phi float [ 0.000000e+00, %29 ], [ %44, %33 ]
  %49 = getelementptr inbounds float, ptr %13, i64 %30
  store float %48, ptr %49, align 4
  %50 = add nuw i64 %30, 1
  %51 = icmp eq i64 %30, %15
  br i1 %51, label %21, label %29

52:
  %53 = phi i64 [ 0, %25 ], [ %73, %70 ]
  %54 = mul nsw i64 %53, %15
  %55 = getelementptr inbounds float, ptr %28, i64 %54
  br i1 %27, label %56, label %70

56:
  %57 = phi i64 [ %68, %56 ], [ 0, %52 ]
  %58 = phi float [ %67, %56 ], [ 0.000000e+00, %52 ]
  %59 = getelementptr inbounds float, ptr %55, i64 %57
  %60 = load float, ptr %59, align 4
  %61 = getelementptr inbounds float, ptr %2, i64 %57
  %62 = load float, ptr %61, align 4
  %63 = fcmp contract olt float %62, 0.000000e+00
  %64 = fneg contract float %62
  %65 = select contract i1 %63, float %64, float %62
  %66 = fmul contract float %60, %65
  %67 = fadd contract float %58, %66
  %68 = add nuw nsw i64 %57, 1
  %69 = icmp eq i64 %68, %15
  br i1 %69, label %70, label %56

70:
  %71 = phi float [ 0.000000e+00, %52 ], [ %67, %56 ]
  %72 = getelementptr inbounds float, ptr %14, i64 %53
  store float %71, ptr %72, align 4
  %73 = add nuw nsw i64 %53, 1
  %74 = icmp eq i64 %73, %23
  br i1 %74, label %75, label %52

75:
  br label %76

76:
  %77 = phi i64 [ %79, %76 ], [ 68, %75 ]
  %78 = getelementptr inbounds i8, ptr %13, i64 %77
  store float %4, ptr %78, align 4
  %79 = add nuw nsw i64 %77, 4
  %80 = icmp eq i64 %79, 136
  br i1 %80, label %110, label %76

81:
  br i1 %16, label %82, label %84

82:
  %83 = phi float [ 0.000000e+00, %81 ], [ %90, %84 ]
  br i1 %24, label %93, label %102

84:
  %85 = phi i64 [ %91, %84 ], [ 0, %81 ]
  %86 = phi float [ %90, %84 ], [ 0.000000e+00, %81 ]
  %87 = getelementptr inbounds [17 x float], ptr %13, i64 0, i64 %85
  %88 = load float, ptr %87, align 4
  %89 = fcmp contract ogt float %88, %86
  %90 = select i1 %89, float %88, float %86
  %91 = add nuw i64 %85, 1
  %92 = icmp eq i64 %85, %15
  br i1 %92, label %82, label %84

93:
  %94 = phi i64 [ %100, %93 ], [ 0, %82 ]
  %95 = phi float [ %99, %93 ], [ %83, %82 ]
  %96 = getelementptr inbounds [136 x float], ptr %14, i64 0, i64 %94
  %97 = load float, ptr %96, align 4
  %98 = fcmp contract ogt float %97, %95
  %99 = select i1 %98, float %97, float %95
  %100 = add nuw nsw i64 %94, 1
  %101 = icmp eq i64 %100, %23
  br i1 %101, label %102, label %93

102:
  %103 = phi float [ %83, %82 ], [ %99, %93 ]
  %104 = fmul contract float %3, 1.600000e+01
  %105 = fdiv contract float %103, %104
  %106 = fptosi float %105 to i64
  %107 = add i64 %106, 1
  %108 = shl nsw i64 %107, 4
  %109 = sitofp i64 %108 to float
  br label %154

110:
  %111 = phi i64 [ %113, %110 ], [ 680, %76 ]
  %112 = getelementptr inbounds i8, ptr %13, i64 %111
  store float %4, ptr %112, align 4
  %113 = add nuw nsw i64 %111, 4
  %114 = icmp eq i64 %113, 1224
  br i1 %114, label %81, label %110

115:
  %116 = icmp slt i64 %106, 0
  br i1 %116, label %1259, label %117

117:
  %118 = fdiv contract float 1.000000e+00, %109
  %119 = insertelement <16 x float> poison, float %118, i64 0
  %120 = shufflevector <16 x float> %119, <16 x float> poison, <16 x i32> zeroinitializer
  %121 = icmp sgt i64 %15, 0
  %122 = getelementptr inbounds i8, ptr %0, i64 24
  %123 = load ptr, ptr %122, align 8
  %124 = getelementptr inbounds i8, ptr %12, i64 576
  %125 = icmp slt i64 %15, 1
  %126 = getelementptr inbounds i8, ptr %13, i64 68
  %127 = getelementptr inbounds i8, ptr %13, i64 680
  %128 = getelementptr inbounds i8, ptr %0, i64 48
  %129 = load ptr, ptr %128, align 8
  %130 = getelementptr inbounds i8, ptr %0, i64 8
  %131 = load i64, ptr %130, align 8
  %132 = icmp sgt i64 %131, 0
  %133 = getelementptr inbounds i8, ptr %0, i64 56
  %134 = load ptr, ptr %133, align 8
  %135 = getelementptr inbounds i8, ptr %0, i64 64
  %136 = load ptr, ptr %135, align 8
  %137 = getelementptr inbounds i8, ptr %0, i64 32
  %138 = load ptr, ptr %137, align 8
  %139 = getelementptr inbounds i8, ptr %0, i64 40
  %140 = load ptr, ptr %139, align 8
  %141 = getelementptr inbounds i8, ptr %0, i64 96
  %142 = load ptr, ptr %141, align 8
  %143 = getelementptr inbounds i8, ptr %0, i64 88
  %144 = load ptr, ptr %143, align 8
  %145 = getelementptr inbounds i8, ptr %0, i64 128
  %146 = load ptr, ptr %145, align 8
  %147 = getelementptr inbounds i8, ptr %7, i64 8
  %148 = getelementptr inbounds i8, ptr %0, i64 80
  %149 = load ptr, ptr %148, align 8
  %150 = getelementptr inbounds i8, ptr %0, i64 72
  %151 = load ptr, ptr %150, align 8
  %152 = getelementptr inbounds i8, ptr %0, i64 104
  %153 = load ptr, ptr %152, align 8
  br label %167

154:
  %155 = phi i64 [ 0, %102 ], [ %161, %154 ]
  %156 = phi <16 x float> [ undef, %102 ], [ %160, %154 ]
  %157 = mul nsw i64 %155, %107
  %158 = add nsw i64 %157, 1
  %159 = sitofp i64 %158 to float
  %160 = insertelement <16 x float> %156, float %159, i64 %155
  %161 = add nuw nsw i64 %155, 1
  %162 = icmp eq i64 %161, 16
  br i1 %162, label %115, label %154

163:
  %164 = add nuw i64 %169, 1
  %165 = icmp sge i64 %169, %106
  %166 = icmp eq i64 %169, %106
  br i1 %166, label %1259, label %167

167:
  %168 = phi i1 [ false, %117 ], [ %165, %163 ]
  %169 = phi i64 [ 0, %117 ], [ %164, %163 ]
  %170 = uitofp nneg i64 %169 to float
  %171 = insertelement <16 x float> poison, float %170, i64 0
  %172 = shufflevector <16 x float> %171, <16 x float> poison, <16 x i32> zeroinitializer
  %173 = fadd contract <16 x float> %160, %172
  %174 = fmul contract <16 x float> %120, %173
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 1088, ptr nonnull %10)
  call void @llvm.lifetime.start.p0(i64 8704, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %12)
  br i1 %121, label %383, label %175

175:
  br label %176

176:
  %177 = phi i64 [ %184, %176 ], [ 0, %175 ]
  %178 = and i64 %177, 3
  %179 = icmp eq i64 %178, 0
  %180 = uitofp i1 %179 to float
  %181 = insertelement <16 x float> poison, float %180, i64 0
  %182 = shufflevector <16 x float> %181, <16 x float> poison, <16 x i32> zeroinitializer
  %183 = getelementptr inbounds [9 x <16 x float>], ptr %12, i64 0, i64 %177
  store <16 x float> %182, ptr %183, align 64
  %184 = add nuw nsw i64 %177, 1
  %185 = icmp eq i64 %184, 9
  br i1 %185, label %187, label %176

186:
  br i1 %121, label %193, label %398

187:
  %188 = phi i64 [ %190, %187 ], [ 0, %176 ]
  %189 = getelementptr inbounds [3 x <16 x float>], ptr %124, i64 0, i64 %188
  store <16 x float> zeroinitializer, ptr %189, align 64
  %190 = add nuw nsw i64 %188, 1
  %191 = icmp eq i64 %190, 3
  br i1 %191, label %186, label %187

192:
  br i1 %125, label %398, label %399

193:
  %194 = phi i64 [ %197, %381 ], [ 0, %186 ]
  %195 = getelementptr inbounds %struct.Joint, ptr %123, i64 %194
  %196 = getelementptr inbounds %struct.Frame, ptr %12, i64 %194
  %197 = add nuw nsw i64 %194, 1
  %198 = getelementptr inbounds <16 x float>, ptr %9, i64 %194
  %199 = load <16 x float>, ptr %198, align 64
  %200 = getelementptr inbounds i8, ptr %195, i64 36
  %201 = load float, ptr %200, align 4
  %202 = getelementptr inbounds i8, ptr %195, i64 40
  %203 = load float, ptr %202, align 4
  %204 = getelementptr inbounds i8, ptr %195, i64 44
  %205 = load float, ptr %204, align 4
  %206 = getelementptr inbounds i8, ptr %196, i64 576
  %207 = load <16 x float>, ptr %206, align 64
  %208 = load <16 x float>, ptr %196, align 64
  %209 = insertelement <16 x float> poison, float %201, i64 0
  %210 = shufflevector <16 x float> %209, <16 x float> poison, <16 x i32> zeroinitializer
  %211 = fmul contract <16 x float> %210, %208
  %212 = getelementptr inbounds i8, ptr %196, i64 64
  %213 = load <16 x float>, ptr %212, align 64
  %214 = insertelement <16 x float> poison, float %203, i64 0
  %215 = shufflevector <16 x float> %214, <16 x float> poison, <16 x i32> zeroinitializer
  %216 = fmul contract <16 x float> %215, %213
  %217 = getelementptr inbounds i8, ptr %196, i64 128
  %218 = load <16 x float>, ptr %217, align 64
  %219 = insertelement <16 x float> poison, float %205, i64 0
  %220 = shufflevector <16 x float> %219, <16 x float> poison, <16 x i32> zeroinitializer
  %221 = fmul contract <16 x float> %220, %218
  %222 = getelementptr inbounds i8, ptr %196, i64 640
  %223 = load <16 x float>, ptr %222, align 64
  %224 = getelementptr inbounds i8, ptr %196, i64 192
  %225 = load <16 x float>, ptr %224, align 64
  %226 = fmul contract <16 x float> %210, %225
  %227 = getelementptr inbounds i8, ptr %196, i64 256
  %228 = load <16 x float>, ptr %227, align 64
  %229 = fmul contract <16 x float> %215, %228
  %230 = getelementptr inbounds i8, ptr %196, i64 320
  %231 = load <16 x float>, ptr %230, align 64
  %232 = fmul contract <16 x float> %220, %231
  %233 = getelementptr inbounds i8, ptr %196, i64 704
  %234 = load <16 x float>, ptr %233, align 64
  %235 = getelementptr inbounds i8, ptr %196, i64 384
  %236 = load <16 x float>, ptr %235, align 64
  %237 = fmul contract <16 x float> %210, %236
  %238 = getelementptr inbounds i8, ptr %196, i64 448
  %239 = load <16 x float>, ptr %238, align 64
  %240 = fmul contract <16 x float> %215, %239
  %241 = getelementptr inbounds i8, ptr %196, i64 512
  %242 = load <16 x float>, ptr %241, align 64
  %243 = fmul contract <16 x float> %220, %242
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %8)
  br label %244

244:
  %245 = phi i64 [ 0, %193 ], [ %273, %272 ]
  %246 = mul nuw nsw i64 %245, 3
  %247 = getelementptr inbounds [9 x <16 x float>], ptr %196, i64 0, i64 %246
  %248 = load <16 x float>, ptr %247, align 64
  %249 = add nuw nsw i64 %246, 1
  %250 = getelementptr inbounds [9 x <16 x float>], ptr %196, i64 0, i64 %249
  %251 = load <16 x float>, ptr %250, align 64
  %252 = add nuw nsw i64 %246, 2
  %253 = getelementptr inbounds [9 x <16 x float>], ptr %196, i64 0, i64 %252
  %254 = load <16 x float>, ptr %253, align 64
  br label %275

255:
  %256 = getelementptr inbounds %struct.Frame, ptr %12, i64 %197
  %257 = fadd contract <16 x float> %207, %211
  %258 = fadd contract <16 x float> %257, %216
  %259 = fadd contract <16 x float> %258, %221
  %260 = fadd contract <16 x float> %223, %226
  %261 = fadd contract <16 x float> %260, %229
  %262 = fadd contract <16 x float> %261, %232
  %263 = fadd contract <16 x float> %234, %237
  %264 = fadd contract <16 x float> %263, %240
  %265 = fadd contract <16 x float> %264, %243
  %266 = getelementptr inbounds i8, ptr %256, i64 576
  store <16 x float> %259, ptr %266, align 64
  %267 = getelementptr inbounds i8, ptr %256, i64 640
  store <16 x float> %262, ptr %267, align 64
  %268 = getelementptr inbounds i8, ptr %256, i64 704
  store <16 x float> %265, ptr %268, align 64
  %269 = getelementptr inbounds i8, ptr %195, i64 48
  %270 = load float, ptr %269, align 4
  %271 = fcmp contract une float %270, 0.000000e+00
  br i1 %271, label %300, label %319

272:
  %273 = add nuw nsw i64 %245, 1
  %274 = icmp eq i64 %273, 3
  br i1 %274, label %255, label %244

275:
  %276 = phi i64 [ 0, %244 ], [ %298, %275 ]
  %277 = getelementptr inbounds [9 x float], ptr %195, i64 0, i64 %276
  %278 = load float, ptr %277, align 4
  %279 = insertelement <16 x float> poison, float %278, i64 0
  %280 = shufflevector <16 x float> %279, <16 x float> poison, <16 x i32> zeroinitializer
  %281 = fmul contract <16 x float> %248, %280
  %282 = add nuw nsw i64 %276, 3
  %283 = getelementptr inbounds [9 x float], ptr %195, i64 0, i64 %282
  %284 = load float, ptr %283, align 4
  %285 = insertelement <16 x float> poison, float %284, i64 0
  %286 = shufflevector <16 x float> %285, <16 x float> poison, <16 x i32> zeroinitializer
  %287 = fmul contract <16 x float> %251, %286
  %288 = fadd contract <16 x float> %281, %287
  %289 = add nuw nsw i64 %276, 6
  %290 = getelementptr inbounds [9 x float], ptr %195, i64 0, i64 %289
  %291 = load float, ptr %290, align 4
  %292 = insertelement <16 x float> poison, float %291, i64 0
  %293 = shufflevector <16 x float> %292, <16 x float> poison, <16 x i32> zeroinitializer
  %294 = fmul contract <16 x float> %254, %293
  %295 = fadd contract <16 x float> %288, %294
  %296 = add nuw nsw i64 %276, %246
  %297 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %296
  store <16 x float> %295, ptr %297, align 64
  %298 = add nuw nsw i64 %276, 1
  %299 = icmp eq i64 %298, 3
  br i1 %299, label %272, label %275

300:
  %301 = phi i64 [ %305, %300 ], [ 0, %255 ]
  %302 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %301
  %303 = load <16 x float>, ptr %302, align 64
  %304 = getelementptr inbounds [9 x <16 x float>], ptr %256, i64 0, i64 %301
  store <16 x float> %303, ptr %304, align 64
  %305 = add nuw nsw i64 %301, 1
  %306 = icmp eq i64 %305, 9
  br i1 %306, label %307, label %300

307:
  %308 = phi i64 [ %317, %307 ], [ 0, %300 ]
  %309 = mul nuw nsw i64 %308, 3
  %310 = add nuw nsw i64 %309, 2
  %311 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %310
  %312 = load <16 x float>, ptr %311, align 64
  %313 = fmul contract <16 x float> %199, %312
  %314 = getelementptr inbounds [3 x <16 x float>], ptr %266, i64 0, i64 %308
  %315 = load <16 x float>, ptr %314, align 64
  %316 = fadd contract <16 x float> %315, %313
  store <16 x float> %316, ptr %314, align 64
  %317 = add nuw nsw i64 %308, 1
  %318 = icmp eq i64 %317, 3
  br i1 %318, label %381, label %307

319:
  %320 = fmul contract <16 x float> %199, <float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000>
  %321 = fadd contract <16 x float> %320, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %322 = fadd contract <16 x float> %321, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %323 = fmul contract <16 x float> %322, <float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000>
  %324 = fsub contract <16 x float> %199, %323
  %325 = fmul contract <16 x float> %322, <float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000>
  %326 = fsub contract <16 x float> %324, %325
  %327 = fmul contract <16 x float> %322, <float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000>
  %328 = fsub contract <16 x float> %326, %327
  %329 = fmul contract <16 x float> %322, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %330 = fadd contract <16 x float> %329, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %331 = fadd contract <16 x float> %330, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %332 = fsub contract <16 x float> %329, %331
  %333 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %332)
  %334 = fmul contract <16 x float> %333, <float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00>
  %335 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %334
  %336 = fmul contract <16 x float> %328, %328
  %337 = fmul contract <16 x float> %328, %336
  %338 = fmul contract <16 x float> %336, <float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000>
  %339 = fadd contract <16 x float> %338, <float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000>
  %340 = fmul contract <16 x float> %336, %339
  %341 = fadd contract <16 x float> %340, <float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000>
  %342 = fmul contract <16 x float> %336, %341
  %343 = fadd contract <16 x float> %342, <float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000>
  %344 = fmul contract <16 x float> %337, %343
  %345 = fadd contract <16 x float> %328, %344
  %346 = fmul contract <16 x float> %335, %345
  %347 = fmul contract <16 x float> %336, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %348 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %347
  %349 = fmul contract <16 x float> %336, %336
  %350 = fmul contract <16 x float> %336, <float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000>
  %351 = fsub contract <16 x float> <float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000>, %350
  %352 = fmul contract <16 x float> %336, %351
  %353 = fadd contract <16 x float> %352, <float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000>
  %354 = fmul contract <16 x float> %336, %353
  %355 = fadd contract <16 x float> %354, <float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000>
  %356 = fmul contract <16 x float> %349, %355
  %357 = fadd contract <16 x float> %348, %356
  %358 = fmul contract <16 x float> %335, %357
  br label %359

359:
  %360 = phi i64 [ 0, %319 ], [ %379, %359 ]
  %361 = mul nuw nsw i64 %360, 3
  %362 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %361
  %363 = load <16 x float>, ptr %362, align 64
  %364 = fmul contract <16 x float> %358, %363
  %365 = add nuw nsw i64 %361, 1
  %366 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %365
  %367 = load <16 x float>, ptr %366, align 64
  %368 = fmul contract <16 x float> %346, %367
  %369 = fadd contract <16 x float> %364, %368
  %370 = getelementptr inbounds [9 x <16 x float>], ptr %256, i64 0, i64 %361
  store <16 x float> %369, ptr %370, align 64
  %371 = fmul contract <16 x float> %358, %367
  %372 = fmul contract <16 x float> %346, %363
  %373 = fsub contract <16 x float> %371, %372
  %374 = getelementptr inbounds [9 x <16 x float>], ptr %256, i64 0, i64 %365
  store <16 x float> %373, ptr %374, align 64
  %375 = add nuw nsw i64 %361, 2
  %376 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %375
  %377 = load <16 x float>, ptr %376, align 64
  %378 = getelementptr inbounds [9 x <16 x float>], ptr %256, i64 0, i64 %375
  store <16 x float> %377, ptr %378, align 64
  %379 = add nuw nsw i64 %360, 1
  %380 = icmp eq i64 %379, 3
  br i1 %380, label %381, label %359

381:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %8)
  %382 = icmp eq i64 %197, %15
  br i1 %382, label %192, label %193

383:
  %384 = phi i64 [ %396, %383 ], [ 0, %167 ]
  %385 = getelementptr inbounds float, ptr %1, i64 %384
  %386 = load float, ptr %385, align 4
  %387 = insertelement <16 x float> poison, float %386, i64 0
  %388 = shufflevector <16 x float> %387, <16 x float> poison, <16 x i32> zeroinitializer
  %389 = getelementptr inbounds float, ptr %2, i64 %384
  %390 = load float, ptr %389, align 4
  %391 = insertelement <16 x float> poison, float %390, i64 0
  %392 = shufflevector <16 x float> %391, <16 x float> poison, <16 x i32> zeroinitializer
  %393 = fmul contract <16 x float> %174, %392
  %394 = fadd contract <16 x float> %388, %393
  %395 = getelementptr inbounds [16 x <16 x float>], ptr %9, i64 0, i64 %384
  store <16 x float> %394, ptr %395, align 64
  %396 = add nuw nsw i64 %384, 1
  %397 = icmp eq i64 %396, %15
  br i1 %397, label %175, label %383

398:
  br i1 %24, label %414, label %413

399:
  %400 = phi i64 [ %411, %399 ], [ 1, %192 ]
  %401 = getelementptr inbounds [17 x float], ptr %13, i64 0, i64 %400
  %402 = load float, ptr %401, align 4
  %403 = insertelement <16 x float> poison, float %402, i64 0
  %404 = fmul contract <16 x float> %403, <float 0.000000e+00, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison>
  %405 = getelementptr inbounds [17 x float], ptr %126, i64 0, i64 %400
  %406 = load float, ptr %405, align 4
  %407 = insertelement <16 x float> poison, float %406, i64 0
  %408 = fadd contract <16 x float> %404, %407
  %409 = shufflevector <16 x float> %408, <16 x float> poison, <16 x i32> zeroinitializer
  %410 = getelementptr inbounds [17 x <16 x float>], ptr %10, i64 0, i64 %400
  store <16 x float> %409, ptr %410, align 64
  %411 = add nuw i64 %400, 1
  %412 = icmp eq i64 %400, %15
  br i1 %412, label %398, label %399

413:
  br i1 %125, label %751, label %428

414:
  %415 = phi i64 [ %426, %414 ], [ 0, %398 ]
  %416 = getelementptr inbounds [136 x float], ptr %14, i64 0, i64 %415
  %417 = load float, ptr %416, align 4
  %418 = insertelement <16 x float> poison, float %417, i64 0
  %419 = fmul contract <16 x float> %418, <float 0.000000e+00, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison>
  %420 = getelementptr inbounds [136 x float], ptr %127, i64 0, i64 %415
  %421 = load float, ptr %420, align 4
  %422 = insertelement <16 x float> poison, float %421, i64 0
  %423 = fadd contract <16 x float> %419, %422
  %424 = shufflevector <16 x float> %423, <16 x float> poison, <16 x i32> zeroinitializer
  %425 = getelementptr inbounds [136 x <16 x float>], ptr %11, i64 0, i64 %415
  store <16 x float> %424, ptr %425, align 64
  %426 = add nuw nsw i64 %415, 1
  %427 = icmp eq i64 %426, %23
  br i1 %427, label %413, label %414

428:
  %429 = phi <16 x i32> [ %748, %747 ], [ zeroinitializer, %413 ]
  %430 = phi i64 [ %749, %747 ], [ 1, %413 ]
  %431 = getelementptr inbounds %struct.Sphere, ptr %129, i64 %430
  %432 = getelementptr inbounds i8, ptr %431, i64 12
  %433 = load float, ptr %432, align 4
  %434 = fcmp contract olt float %433, 0.000000e+00
  br i1 %434, label %747, label %435

435:
  %436 = getelementptr inbounds %struct.Frame, ptr %12, i64 %430
  %437 = load float, ptr %431, align 4
  %438 = getelementptr inbounds i8, ptr %431, i64 4
  %439 = load float, ptr %438, align 4
  %440 = getelementptr inbounds i8, ptr %431, i64 8
  %441 = load float, ptr %440, align 4
  %442 = getelementptr inbounds i8, ptr %436, i64 576
  %443 = load <16 x float>, ptr %442, align 64
  %444 = load <16 x float>, ptr %436, align 64
  %445 = insertelement <16 x float> poison, float %437, i64 0
  %446 = shufflevector <16 x float> %445, <16 x float> poison, <16 x i32> zeroinitializer
  %447 = fmul contract <16 x float> %446, %444
  %448 = fadd contract <16 x float> %443, %447
  %449 = getelementptr inbounds i8, ptr %436, i64 64
  %450 = load <16 x float>, ptr %449, align 64
  %451 = insertelement <16 x float> poison, float %439, i64 0
  %452 = shufflevector <16 x float> %451, <16 x float> poison, <16 x i32> zeroinitializer
  %453 = fmul contract <16 x float> %452, %450
  %454 = fadd contract <16 x float> %448, %453
  %455 = getelementptr inbounds i8, ptr %436, i64 128
  %456 = load <16 x float>, ptr %455, align 64
  %457 = insertelement <16 x float> poison, float %441, i64 0
  %458 = shufflevector <16 x float> %457, <16 x float> poison, <16 x i32> zeroinitializer
  %459 = fmul contract <16 x float> %458, %456
  %460 = fadd contract <16 x float> %454, %459
  %461 = getelementptr inbounds i8, ptr %436, i64 640
  %462 = load <16 x float>, ptr %461, align 64
  %463 = getelementptr inbounds i8, ptr %436, i64 192
  %464 = load <16 x float>, ptr %463, align 64
  %465 = fmul contract <16 x float> %446, %464
  %466 = fadd contract <16 x float> %462, %465
  %467 = getelementptr inbounds i8, ptr %436, i64 256
  %468 = load <16 x float>, ptr %467, align 64
  %469 = fmul contract <16 x float> %452, %468
  %470 = fadd contract <16 x float> %466, %469
  %471 = getelementptr inbounds i8, ptr %436, i64 320
  %472 = load <16 x float>, ptr %471, align 64
  %473 = fmul contract <16 x float> %458, %472
  %474 = fadd contract <16 x float> %470, %473
  %475 = getelementptr inbounds i8, ptr %436, i64 704
  %476 = load <16 x float>, ptr %475, align 64
  %477 = getelementptr inbounds i8, ptr %436, i64 384
  %478 = load <16 x float>, ptr %477, align 64
  %479 = fmul contract <16 x float> %446, %478
  %480 = fadd contract <16 x float> %476, %479
  %481 = getelementptr inbounds i8, ptr %436, i64 448
  %482 = load <16 x float>, ptr %481, align 64
  %483 = fmul contract <16 x float> %452, %482
  %484 = fadd contract <16 x float> %480, %483
  %485 = getelementptr inbounds i8, ptr %436, i64 512
  %486 = load <16 x float>, ptr %485, align 64
  %487 = fmul contract <16 x float> %458, %486
  %488 = fadd contract <16 x float> %484, %487
  %489 = getelementptr inbounds <16 x float>, ptr %10, i64 %430
  %490 = load <16 x float>, ptr %489, align 64
  br i1 %132, label %491, label %747

491:
  %492 = mul nuw nsw i64 %131, %430
  %493 = getelementptr float, ptr %136, i64 %492
  %494 = getelementptr inbounds i64, ptr %138, i64 %430
  %495 = getelementptr inbounds i8, ptr %494, i64 8
  br label %496

496:
  %497 = phi <16 x i32> [ %429, %491 ], [ %744, %743 ]
  %498 = phi i64 [ 0, %491 ], [ %745, %743 ]
  %499 = getelementptr inbounds %struct.Object, ptr %134, i64 %498
  %500 = getelementptr float, ptr %493, i64 %498
  %501 = load float, ptr %500, align 4
  %502 = getelementptr inbounds i8, ptr %499, i64 60
  %503 = load float, ptr %502, align 4
  %504 = fadd contract float %501, %503
  %505 = fcmp contract olt float %504, -1.000000e+08
  br i1 %505, label %743, label %506

506:
  %507 = fadd contract float %433, %504
  %508 = insertelement <16 x float> poison, float %507, i64 0
  %509 = shufflevector <16 x float> %508, <16 x float> poison, <16 x i32> zeroinitializer
  %510 = fadd contract <16 x float> %490, %509
  %511 = fcmp contract ogt <16 x float> %510, zeroinitializer
  %512 = select contract <16 x i1> %511, <16 x float> %510, <16 x float> zeroinitializer
  %513 = getelementptr inbounds i8, ptr %499, i64 36
  %514 = load float, ptr %513, align 4
  %515 = insertelement <16 x float> poison, float %514, i64 0
  %516 = shufflevector <16 x float> %515, <16 x float> poison, <16 x i32> zeroinitializer
  %517 = load float, ptr %499, align 4
  %518 = insertelement <16 x float> poison, float %517, i64 0
  %519 = shufflevector <16 x float> %518, <16 x float> poison, <16 x i32> zeroinitializer
  %520 = fmul contract <16 x float> %460, %519
  %521 = fadd contract <16 x float> %516, %520
  %522 = getelementptr inbounds i8, ptr %499, i64 4
  %523 = load float, ptr %522, align 4
  %524 = insertelement <16 x float> poison, float %523, i64 0
  %525 = shufflevector <16 x float> %524, <16 x float> poison, <16 x i32> zeroinitializer
  %526 = fmul contract <16 x float> %474, %525
  %527 = fadd contract <16 x float> %521, %526
  %528 = getelementptr inbounds i8, ptr %499, i64 8
  %529 = load float, ptr %528, align 4
  %530 = insertelement <16 x float> poison, float %529, i64 0
  %531 = shufflevector <16 x float> %530, <16 x float> poison, <16 x i32> zeroinitializer
  %532 = fmul contract <16 x float> %488, %531
  %533 = fadd contract <16 x float> %527, %532
  %534 = getelementptr inbounds i8, ptr %499, i64 40
  %535 = load float, ptr %534, align 4
  %536 = insertelement <16 x float> poison, float %535, i64 0
  %537 = shufflevector <16 x float> %536, <16 x float> poison, <16 x i32> zeroinitializer
  %538 = getelementptr inbounds i8, ptr %499, i64 12
  %539 = load float, ptr %538, align 4
  %540 = insertelement <16 x float> poison, float %539, i64 0
  %541 = shufflevector <16 x float> %540, <16 x float> poison, <16 x i32> zeroinitializer
  %542 = fmul contract <16 x float> %460, %541
  %543 = fadd contract <16 x float> %537, %542
  %544 = getelementptr inbounds i8, ptr %499, i64 16
  %545 = load float, ptr %544, align 4
  %546 = insertelement <16 x float> poison, float %545, i64 0
  %547 = shufflevector <16 x float> %546, <16 x float> poison, <16 x i32> zeroinitializer
  %548 = fmul contract <16 x float> %474, %547
  %549 = fadd contract <16 x float> %543, %548
  %550 = getelementptr inbounds i8, ptr %499, i64 20
  %551 = load float, ptr %550, align 4
  %552 = insertelement <16 x float> poison, float %551, i64 0
  %553 = shufflevector <16 x float> %552, <16 x float> poison, <16 x i32> zeroinitializer
  %554 = fmul contract <16 x float> %488, %553
  %555 = fadd contract <16 x float> %549, %554
  %556 = getelementptr inbounds i8, ptr %499, i64 44
  %557 = load float, ptr %556, align 4
  %558 = insertelement <16 x float> poison, float %557, i64 0
  %559 = shufflevector <16 x float> %558, <16 x float> poison, <16 x i32> zeroinitializer
  %560 = getelementptr inbounds i8, ptr %499, i64 24
  %561 = load float, ptr %560, align 4
  %562 = insertelement <16 x float> poison, float %561, i64 0
  %563 = shufflevector <16 x float> %562, <16 x float> poison, <16 x i32> zeroinitializer
  %564 = fmul contract <16 x float> %460, %563
  %565 = fadd contract <16 x float> %559, %564
  %566 = getelementptr inbounds i8, ptr %499, i64 28
  %567 = load float, ptr %566, align 4
  %568 = insertelement <16 x float> poison, float %567, i64 0
  %569 = shufflevector <16 x float> %568, <16 x float> poison, <16 x i32> zeroinitializer
  %570 = fmul contract <16 x float> %474, %569
  %571 = fadd contract <16 x float> %565, %570
  %572 = getelementptr inbounds i8, ptr %499, i64 32
  %573 = load float, ptr %572, align 4
  %574 = insertelement <16 x float> poison, float %573, i64 0
  %575 = shufflevector <16 x float> %574, <16 x float> poison, <16 x i32> zeroinitializer
  %576 = fmul contract <16 x float> %488, %575
  %577 = fadd contract <16 x float> %571, %576
  %578 = fmul contract <16 x float> %533, zeroinitializer
  %579 = getelementptr inbounds i8, ptr %499, i64 68
  %580 = load float, ptr %579, align 4
  %581 = fcmp contract une float %580, 0.000000e+00
  %582 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %577)
  %583 = select contract i1 %581, <16 x float> %577, <16 x float> %582
  %584 = getelementptr inbounds i8, ptr %499, i64 64
  %585 = load float, ptr %584, align 4
  %586 = fcmp contract une float %585, 0.000000e+00
  br i1 %586, label %587, label %592

587:
  %588 = fmul contract <16 x float> %533, %533
  %589 = fmul contract <16 x float> %555, %555
  %590 = fadd contract <16 x float> %588, %589
  %591 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %590)
  br label %594

592:
  %593 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %533)
  br label %594

594:
  %595 = phi contract <16 x float> [ %591, %587 ], [ %593, %592 ]
  %596 = getelementptr inbounds i8, ptr %499, i64 48
  %597 = load float, ptr %596, align 4
  %598 = insertelement <16 x float> poison, float %597, i64 0
  %599 = shufflevector <16 x float> %598, <16 x float> poison, <16 x i32> zeroinitializer
  %600 = fsub contract <16 x float> %595, %599
  %601 = fcmp contract ogt <16 x float> %600, %578
  %602 = select contract <16 x i1> %601, <16 x float> %600, <16 x float> %578
  %603 = getelementptr inbounds i8, ptr %499, i64 56
  %604 = load float, ptr %603, align 4
  %605 = insertelement <16 x float> poison, float %604, i64 0
  %606 = shufflevector <16 x float> %605, <16 x float> poison, <16 x i32> zeroinitializer
  %607 = fsub contract <16 x float> %583, %606
  %608 = fcmp contract ogt <16 x float> %607, %578
  %609 = select contract <16 x i1> %608, <16 x float> %607, <16 x float> %578
  %610 = fmul contract <16 x float> %602, %602
  %611 = fmul contract <16 x float> %609, %609
  %612 = fadd contract <16 x float> %610, %611
  br i1 %586, label %624, label %613

613:
  %614 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %555)
  %615 = getelementptr inbounds i8, ptr %499, i64 52
  %616 = load float, ptr %615, align 4
  %617 = insertelement <16 x float> poison, float %616, i64 0
  %618 = shufflevector <16 x float> %617, <16 x float> poison, <16 x i32> zeroinitializer
  %619 = fsub contract <16 x float> %614, %618
  %620 = fcmp contract ogt <16 x float> %619, %578
  %621 = select contract <16 x i1> %620, <16 x float> %619, <16 x float> %578
  %622 = fmul contract <16 x float> %621, %621
  %623 = fadd contract <16 x float> %612, %622
  br label %624

624:
  %625 = phi <16 x float> [ %623, %613 ], [ %612, %594 ]
  %626 = fmul contract <16 x float> %512, %512
  %627 = fcmp contract olt <16 x float> %625, %626
  %628 = bitcast <16 x i1> %627 to i16
  %629 = icmp eq i16 %628, 0
  br i1 %629, label %743, label %630

630:
  %631 = load i64, ptr %494, align 8
  %632 = load i64, ptr %495, align 8
  %633 = icmp slt i64 %631, %632
  br i1 %633, label %634, label %737

634:
  %635 = getelementptr inbounds i8, ptr %499, i64 52
  br label %639

636:
  %637 = add i64 %641, 1
  %638 = icmp eq i64 %637, %632
  br i1 %638, label %737, label %639

639:
  %640 = phi <16 x i32> [ zeroinitializer, %634 ], [ %733, %636 ]
  %641 = phi i64 [ %631, %634 ], [ %637, %636 ]
  %642 = getelementptr inbounds %struct.Sphere, ptr %140, i64 %641
  %643 = getelementptr inbounds i8, ptr %642, i64 12
  %644 = load float, ptr %643, align 4
  %645 = fadd contract float %504, %644
  %646 = insertelement <16 x float> poison, float %645, i64 0
  %647 = shufflevector <16 x float> %646, <16 x float> poison, <16 x i32> zeroinitializer
  %648 = fadd contract <16 x float> %490, %647
  %649 = fcmp contract ogt <16 x float> %648, zeroinitializer
  %650 = select contract <16 x i1> %649, <16 x float> %648, <16 x float> zeroinitializer
  %651 = load float, ptr %642, align 4
  %652 = getelementptr inbounds i8, ptr %642, i64 4
  %653 = load float, ptr %652, align 4
  %654 = getelementptr inbounds i8, ptr %642, i64 8
  %655 = load float, ptr %654, align 4
  %656 = insertelement <16 x float> poison, float %651, i64 0
  %657 = shufflevector <16 x float> %656, <16 x float> poison, <16 x i32> zeroinitializer
  %658 = fmul contract <16 x float> %444, %657
  %659 = fadd contract <16 x float> %443, %658
  %660 = insertelement <16 x float> poison, float %653, i64 0
  %661 = shufflevector <16 x float> %660, <16 x float> poison, <16 x i32> zeroinitializer
  %662 = fmul contract <16 x float> %450, %661
  %663 = fadd contract <16 x float> %659, %662
  %664 = insertelement <16 x float> poison, float %655, i64 0
  %665 = shufflevector <16 x float> %664, <16 x float> poison, <16 x i32> zeroinitializer
  %666 = fmul contract <16 x float> %456, %665
  %667 = fadd contract <16 x float> %663, %666
  %668 = fmul contract <16 x float> %464, %657
  %669 = fadd contract <16 x float> %462, %668
  %670 = fmul contract <16 x float> %468, %661
  %671 = fadd contract <16 x float> %669, %670
  %672 = fmul contract <16 x float> %472, %665
  %673 = fadd contract <16 x float> %671, %672
  %674 = fmul contract <16 x float> %478, %657
  %675 = fadd contract <16 x float> %476, %674
  %676 = fmul contract <16 x float> %482, %661
  %677 = fadd contract <16 x float> %675, %676
  %678 = fmul contract <16 x float> %486, %665
  %679 = fadd contract <16 x float> %677, %678
  %680 = fmul contract <16 x float> %519, %667
  %681 = fadd contract <16 x float> %516, %680
  %682 = fmul contract <16 x float> %525, %673
  %683 = fadd contract <16 x float> %682, %681
  %684 = fmul contract <16 x float> %531, %679
  %685 = fadd contract <16 x float> %684, %683
  %686 = fmul contract <16 x float> %541, %667
  %687 = fadd contract <16 x float> %537, %686
  %688 = fmul contract <16 x float> %547, %673
  %689 = fadd contract <16 x float> %688, %687
  %690 = fmul contract <16 x float> %553, %679
  %691 = fadd contract <16 x float> %690, %689
  %692 = fmul contract <16 x float> %563, %667
  %693 = fadd contract <16 x float> %559, %692
  %694 = fmul contract <16 x float> %569, %673
  %695 = fadd contract <16 x float> %694, %693
  %696 = fmul contract <16 x float> %575, %679
  %697 = fadd contract <16 x float> %696, %695
  %698 = fmul contract <16 x float> %685, zeroinitializer
  %699 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %697)
  %700 = select contract i1 %581, <16 x float> %697, <16 x float> %699
  br i1 %586, label %701, label %706

701:
  %702 = fmul contract <16 x float> %685, %685
  %703 = fmul contract <16 x float> %691, %691
  %704 = fadd contract <16 x float> %702, %703
  %705 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %704)
  br label %708

706:
  %707 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %685)
  br label %708

708:
  %709 = phi contract <16 x float> [ %705, %701 ], [ %707, %706 ]
  %710 = fsub contract <16 x float> %709, %599
  %711 = fcmp contract ogt <16 x float> %710, %698
  %712 = select contract <16 x i1> %711, <16 x float> %710, <16 x float> %698
  %713 = fsub contract <16 x float> %700, %606
  %714 = fcmp contract ogt <16 x float> %713, %698
  %715 = select contract <16 x i1> %714, <16 x float> %713, <16 x float> %698
  %716 = fmul contract <16 x float> %712, %712
  %717 = fmul contract <16 x float> %715, %715
  %718 = fadd contract <16 x float> %717, %716
  br i1 %586, label %729, label %719

719:
  %720 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %691)
  %721 = load float, ptr %635, align 4
  %722 = insertelement <16 x float> poison, float %721, i64 0
  %723 = shufflevector <16 x float> %722, <16 x float> poison, <16 x i32> zeroinitializer
  %724 = fsub contract <16 x float> %720, %723
  %725 = fcmp contract ogt <16 x float> %724, %698
  %726 = select contract <16 x i1> %725, <16 x float> %724, <16 x float> %698
  %727 = fmul contract <16 x float> %726, %726
  %728 = fadd contract <16 x float> %718, %727
  br label %729

729:
  %730 = phi <16 x float> [ %728, %719 ], [ %718, %708 ]
  %731 = fmul contract <16 x float> %650, %650
  %732 = fcmp contract olt <16 x float> %730, %731
  %733 = select <16 x i1> %732, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %640
  %734 = icmp ne <16 x i32> %733, zeroinitializer
  %735 = bitcast <16 x i1> %734 to i16
  %736 = icmp eq i16 %735, 0
  br i1 %736, label %636, label %1254

737:
  %738 = phi <16 x i32> [ zeroinitializer, %630 ], [ %733, %636 ]
  %739 = or <16 x i32> %738, %497
  %740 = icmp eq <16 x i32> %739, zeroinitializer
  %741 = bitcast <16 x i1> %740 to i16
  %742 = icmp eq i16 %741, 0
  br i1 %742, label %1254, label %743

743:
  %744 = phi <16 x i32> [ %497, %624 ], [ %497, %496 ], [ %739, %737 ]
  %745 = add nuw nsw i64 %498, 1
  %746 = icmp eq i64 %745, %131
  br i1 %746, label %747, label %496

747:
  %748 = phi <16 x i32> [ %429, %428 ], [ %429, %435 ], [ %744, %743 ]
  %749 = add nuw i64 %430, 1
  %750 = icmp eq i64 %430, %15
  br i1 %750, label %751, label %428

751:
  %752 = phi <16 x i32> [ zeroinitializer, %413 ], [ %748, %747 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %6)
  br i1 %24, label %753, label %1252

753:
  %754 = phi <16 x i32> [ %1247, %1246 ], [ %752, %751 ]
  %755 = phi i64 [ %1248, %1246 ], [ 0, %751 ]
  %756 = phi i64 [ %1249, %1246 ], [ 0, %751 ]
  %757 = getelementptr inbounds %struct.LinkPair, ptr %142, i64 %756
  %758 = load i64, ptr %757, align 8
  %759 = getelementptr inbounds %struct.Sphere, ptr %144, i64 %758
  %760 = getelementptr inbounds i8, ptr %757, i64 8
  %761 = load i64, ptr %760, align 8
  %762 = getelementptr inbounds %struct.Sphere, ptr %144, i64 %761
  %763 = getelementptr inbounds %struct.Frame, ptr %12, i64 %758
  %764 = getelementptr inbounds %struct.Frame, ptr %12, i64 %761
  %765 = getelementptr inbounds <16 x float>, ptr %11, i64 %756
  %766 = load <16 x float>, ptr %765, align 64
  %767 = getelementptr inbounds float, ptr %146, i64 %756
  %768 = load float, ptr %767, align 4
  %769 = insertelement <16 x float> poison, float %768, i64 0
  %770 = shufflevector <16 x float> %769, <16 x float> poison, <16 x i32> zeroinitializer
  %771 = fadd contract <16 x float> %766, %770
  %772 = load float, ptr %762, align 4
  %773 = getelementptr inbounds i8, ptr %762, i64 4
  %774 = load float, ptr %773, align 4
  %775 = getelementptr inbounds i8, ptr %762, i64 8
  %776 = load float, ptr %775, align 4
  %777 = getelementptr inbounds i8, ptr %764, i64 576
  %778 = load <16 x float>, ptr %777, align 64
  %779 = load <16 x float>, ptr %764, align 64
  %780 = insertelement <16 x float> poison, float %772, i64 0
  %781 = shufflevector <16 x float> %780, <16 x float> poison, <16 x i32> zeroinitializer
  %782 = fmul contract <16 x float> %781, %779
  %783 = fadd contract <16 x float> %778, %782
  %784 = getelementptr inbounds i8, ptr %764, i64 64
  %785 = load <16 x float>, ptr %784, align 64
  %786 = insertelement <16 x float> poison, float %774, i64 0
  %787 = shufflevector <16 x float> %786, <16 x float> poison, <16 x i32> zeroinitializer
  %788 = fmul contract <16 x float> %787, %785
  %789 = fadd contract <16 x float> %783, %788
  %790 = getelementptr inbounds i8, ptr %764, i64 128
  %791 = load <16 x float>, ptr %790, align 64
  %792 = insertelement <16 x float> poison, float %776, i64 0
  %793 = shufflevector <16 x float> %792, <16 x float> poison, <16 x i32> zeroinitializer
  %794 = fmul contract <16 x float> %793, %791
  %795 = fadd contract <16 x float> %789, %794
  %796 = getelementptr inbounds i8, ptr %764, i64 640
  %797 = load <16 x float>, ptr %796, align 64
  %798 = getelementptr inbounds i8, ptr %764, i64 192
  %799 = load <16 x float>, ptr %798, align 64
  %800 = fmul contract <16 x float> %781, %799
  %801 = fadd contract <16 x float> %797, %800
  %802 = getelementptr inbounds i8, ptr %764, i64 256
  %803 = load <16 x float>, ptr %802, align 64
  %804 = fmul contract <16 x float> %787, %803
  %805 = fadd contract <16 x float> %801, %804
  %806 = getelementptr inbounds i8, ptr %764, i64 320
  %807 = load <16 x float>, ptr %806, align 64
  %808 = fmul contract <16 x float> %793, %807
  %809 = fadd contract <16 x float> %805, %808
  %810 = getelementptr inbounds i8, ptr %764, i64 704
  %811 = load <16 x float>, ptr %810, align 64
  %812 = getelementptr inbounds i8, ptr %764, i64 384
  %813 = load <16 x float>, ptr %812, align 64
  %814 = fmul contract <16 x float> %781, %813
  %815 = fadd contract <16 x float> %811, %814
  %816 = getelementptr inbounds i8, ptr %764, i64 448
  %817 = load <16 x float>, ptr %816, align 64
  %818 = fmul contract <16 x float> %787, %817
  %819 = fadd contract <16 x float> %815, %818
  %820 = getelementptr inbounds i8, ptr %764, i64 512
  %821 = load <16 x float>, ptr %820, align 64
  %822 = fmul contract <16 x float> %793, %821
  %823 = fadd contract <16 x float> %819, %822
  %824 = getelementptr inbounds i8, ptr %759, i64 12
  %825 = load float, ptr %824, align 4
  %826 = getelementptr inbounds i8, ptr %762, i64 12
  %827 = load float, ptr %826, align 4
  %828 = fadd contract float %825, %827
  %829 = insertelement <16 x float> poison, float %828, i64 0
  %830 = shufflevector <16 x float> %829, <16 x float> poison, <16 x i32> zeroinitializer
  %831 = fadd contract <16 x float> %771, %830
  %832 = fcmp contract ogt <16 x float> %831, zeroinitializer
  %833 = select contract <16 x i1> %832, <16 x float> %831, <16 x float> zeroinitializer
  %834 = load float, ptr %759, align 4
  %835 = getelementptr inbounds i8, ptr %759, i64 4
  %836 = load float, ptr %835, align 4
  %837 = getelementptr inbounds i8, ptr %759, i64 8
  %838 = load float, ptr %837, align 4
  %839 = getelementptr inbounds i8, ptr %763, i64 576
  %840 = load <16 x float>, ptr %839, align 64
  %841 = load <16 x float>, ptr %763, align 64
  %842 = insertelement <16 x float> poison, float %834, i64 0
  %843 = shufflevector <16 x float> %842, <16 x float> poison, <16 x i32> zeroinitializer
  %844 = fmul contract <16 x float> %843, %841
  %845 = fadd contract <16 x float> %840, %844
  %846 = getelementptr inbounds i8, ptr %763, i64 64
  %847 = load <16 x float>, ptr %846, align 64
  %848 = insertelement <16 x float> poison, float %836, i64 0
  %849 = shufflevector <16 x float> %848, <16 x float> poison, <16 x i32> zeroinitializer
  %850 = fmul contract <16 x float> %849, %847
  %851 = fadd contract <16 x float> %845, %850
  %852 = getelementptr inbounds i8, ptr %763, i64 128
  %853 = load <16 x float>, ptr %852, align 64
  %854 = insertelement <16 x float> poison, float %838, i64 0
  %855 = shufflevector <16 x float> %854, <16 x float> poison, <16 x i32> zeroinitializer
  %856 = fmul contract <16 x float> %855, %853
  %857 = fadd contract <16 x float> %851, %856
  %858 = getelementptr inbounds i8, ptr %763, i64 640
  %859 = load <16 x float>, ptr %858, align 64
  %860 = getelementptr inbounds i8, ptr %763, i64 192
  %861 = load <16 x float>, ptr %860, align 64
  %862 = fmul contract <16 x float> %843, %861
  %863 = fadd contract <16 x float> %859, %862
  %864 = getelementptr inbounds i8, ptr %763, i64 256
  %865 = load <16 x float>, ptr %864, align 64
  %866 = fmul contract <16 x float> %849, %865
  %867 = fadd contract <16 x float> %863, %866
  %868 = getelementptr inbounds i8, ptr %763, i64 320
  %869 = load <16 x float>, ptr %868, align 64
  %870 = fmul contract <16 x float> %855, %869
  %871 = fadd contract <16 x float> %867, %870
  %872 = getelementptr inbounds i8, ptr %763, i64 704
  %873 = load <16 x float>, ptr %872, align 64
  %874 = getelementptr inbounds i8, ptr %763, i64 384
  %875 = load <16 x float>, ptr %874, align 64
  %876 = fmul contract <16 x float> %843, %875
  %877 = fadd contract <16 x float> %873, %876
  %878 = getelementptr inbounds i8, ptr %763, i64 448
  %879 = load <16 x float>, ptr %878, align 64
  %880 = fmul contract <16 x float> %849, %879
  %881 = fadd contract <16 x float> %877, %880
  %882 = getelementptr inbounds i8, ptr %763, i64 512
  %883 = load <16 x float>, ptr %882, align 64
  %884 = fmul contract <16 x float> %855, %883
  %885 = fadd contract <16 x float> %881, %884
  %886 = fsub contract <16 x float> %857, %795
  %887 = fsub contract <16 x float> %871, %809
  %888 = fsub contract <16 x float> %885, %823
  %889 = fmul contract <16 x float> %886, %886
  %890 = fmul contract <16 x float> %887, %887
  %891 = fadd contract <16 x float> %889, %890
  %892 = fmul contract <16 x float> %888, %888
  %893 = fadd contract <16 x float> %891, %892
  %894 = fmul contract <16 x float> %833, %833
  %895 = fcmp contract olt <16 x float> %893, %894
  %896 = bitcast <16 x i1> %895 to i16
  %897 = icmp eq i16 %896, 0
  br i1 %897, label %1246, label %898

898:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %7)
  store i64 %758, ptr %7, align 16
  store i64 %761, ptr %147, align 8
  br label %905

899:
  %900 = getelementptr inbounds i8, ptr %757, i64 16
  %901 = load i64, ptr %900, align 8
  %902 = getelementptr inbounds i8, ptr %757, i64 24
  %903 = load i64, ptr %902, align 8
  %904 = icmp slt i64 %901, %903
  br i1 %904, label %986, label %1244

905:
  %906 = phi i64 [ %755, %898 ], [ %983, %982 ]
  %907 = phi i64 [ 0, %898 ], [ %984, %982 ]
  %908 = getelementptr inbounds i8, ptr %7, i64 %907
  %909 = load i64, ptr %908, align 8
  %910 = shl nuw i64 1, %909
  %911 = and i64 %910, %906
  %912 = icmp eq i64 %911, 0
  br i1 %912, label %913, label %982

913:
  %914 = or i64 %910, %906
  %915 = getelementptr inbounds i64, ptr %149, i64 %909
  %916 = load i64, ptr %915, align 8
  %917 = getelementptr i8, ptr %915, i64 8
  %918 = load i64, ptr %917, align 8
  %919 = icmp slt i64 %916, %918
  br i1 %919, label %920, label %982

920:
  %921 = getelementptr inbounds %struct.Frame, ptr %12, i64 %909
  %922 = getelementptr inbounds i8, ptr %921, i64 576
  %923 = load <16 x float>, ptr %922, align 64
  %924 = load <16 x float>, ptr %921, align 64
  %925 = getelementptr inbounds i8, ptr %921, i64 64
  %926 = load <16 x float>, ptr %925, align 64
  %927 = getelementptr inbounds i8, ptr %921, i64 128
  %928 = load <16 x float>, ptr %927, align 64
  %929 = getelementptr inbounds i8, ptr %921, i64 640
  %930 = load <16 x float>, ptr %929, align 64
  %931 = getelementptr inbounds i8, ptr %921, i64 192
  %932 = load <16 x float>, ptr %931, align 64
  %933 = getelementptr inbounds i8, ptr %921, i64 256
  %934 = load <16 x float>, ptr %933, align 64
  %935 = getelementptr inbounds i8, ptr %921, i64 320
  %936 = load <16 x float>, ptr %935, align 64
  %937 = getelementptr inbounds i8, ptr %921, i64 704
  %938 = load <16 x float>, ptr %937, align 64
  %939 = getelementptr inbounds i8, ptr %921, i64 384
  %940 = load <16 x float>, ptr %939, align 64
  %941 = getelementptr inbounds i8, ptr %921, i64 448
  %942 = load <16 x float>, ptr %941, align 64
  %943 = getelementptr inbounds i8, ptr %921, i64 512
  %944 = load <16 x float>, ptr %943, align 64
  br label %945

945:
  %946 = phi i64 [ %916, %920 ], [ %980, %945 ]
  %947 = getelementptr inbounds %struct.Part, ptr %151, i64 %946
  %948 = load float, ptr %947, align 4
  %949 = getelementptr inbounds i8, ptr %947, i64 4
  %950 = load float, ptr %949, align 4
  %951 = getelementptr inbounds i8, ptr %947, i64 8
  %952 = load float, ptr %951, align 4
  %953 = insertelement <16 x float> poison, float %948, i64 0
  %954 = shufflevector <16 x float> %953, <16 x float> poison, <16 x i32> zeroinitializer
  %955 = fmul contract <16 x float> %954, %924
  %956 = fadd contract <16 x float> %923, %955
  %957 = insertelement <16 x float> poison, float %950, i64 0
  %958 = shufflevector <16 x float> %957, <16 x float> poison, <16 x i32> zeroinitializer
  %959 = fmul contract <16 x float> %958, %926
  %960 = fadd contract <16 x float> %956, %959
  %961 = insertelement <16 x float> poison, float %952, i64 0
  %962 = shufflevector <16 x float> %961, <16 x float> poison, <16 x i32> zeroinitializer
  %963 = fmul contract <16 x float> %962, %928
  %964 = fadd contract <16 x float> %960, %963
  %965 = fmul contract <16 x float> %954, %932
  %966 = fadd contract <16 x float> %930, %965
  %967 = fmul contract <16 x float> %958, %934
  %968 = fadd contract <16 x float> %966, %967
  %969 = fmul contract <16 x float> %962, %936
  %970 = fadd contract <16 x float> %968, %969
  %971 = fmul contract <16 x float> %954, %940
  %972 = fadd contract <16 x float> %938, %971
  %973 = fmul contract <16 x float> %958, %942
  %974 = fadd contract <16 x float> %972, %973
  %975 = fmul contract <16 x float> %962, %944
  %976 = fadd contract <16 x float> %974, %975
  %977 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %946
  store <16 x float> %964, ptr %977, align 64
  %978 = getelementptr inbounds i8, ptr %977, i64 64
  store <16 x float> %970, ptr %978, align 64
  %979 = getelementptr inbounds i8, ptr %977, i64 128
  store <16 x float> %976, ptr %979, align 64
  %980 = add nsw i64 %946, 1
  %981 = icmp eq i64 %980, %918
  br i1 %981, label %982, label %945

982:
  %983 = phi i64 [ %906, %905 ], [ %914, %913 ], [ %914, %945 ]
  %984 = add nuw nsw i64 %907, 8
  %985 = icmp eq i64 %984, 16
  br i1 %985, label %899, label %905

986:
  %987 = phi <16 x i32> [ %1241, %1238 ], [ %754, %899 ]
  %988 = phi i64 [ %1242, %1238 ], [ %901, %899 ]
  %989 = phi i1 [ %1239, %1238 ], [ false, %899 ]
  %990 = phi i64 [ %1240, %1238 ], [ -1, %899 ]
  %991 = getelementptr inbounds %struct.PartPair, ptr %153, i64 %988
  %992 = load i64, ptr %991, align 8
  %993 = getelementptr inbounds %struct.Part, ptr %151, i64 %992
  %994 = getelementptr inbounds i8, ptr %991, i64 8
  %995 = load i64, ptr %994, align 8
  %996 = getelementptr inbounds %struct.Part, ptr %151, i64 %995
  %997 = icmp eq i64 %992, %990
  br i1 %997, label %1025, label %998

998:
  %999 = getelementptr inbounds i8, ptr %993, i64 28
  %1000 = load float, ptr %999, align 4
  %1001 = fadd contract float %827, %1000
  %1002 = insertelement <16 x float> poison, float %1001, i64 0
  %1003 = shufflevector <16 x float> %1002, <16 x float> poison, <16 x i32> zeroinitializer
  %1004 = fadd contract <16 x float> %771, %1003
  %1005 = fcmp contract ogt <16 x float> %1004, zeroinitializer
  %1006 = select contract <16 x i1> %1005, <16 x float> %1004, <16 x float> zeroinitializer
  %1007 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %992
  %1008 = load <16 x float>, ptr %1007, align 64
  %1009 = fsub contract <16 x float> %1008, %795
  %1010 = getelementptr inbounds i8, ptr %1007, i64 64
  %1011 = load <16 x float>, ptr %1010, align 64
  %1012 = fsub contract <16 x float> %1011, %809
  %1013 = getelementptr inbounds i8, ptr %1007, i64 128
  %1014 = load <16 x float>, ptr %1013, align 64
  %1015 = fsub contract <16 x float> %1014, %823
  %1016 = fmul contract <16 x float> %1009, %1009
  %1017 = fmul contract <16 x float> %1012, %1012
  %1018 = fadd contract <16 x float> %1016, %1017
  %1019 = fmul contract <16 x float> %1015, %1015
  %1020 = fadd contract <16 x float> %1018, %1019
  %1021 = fmul contract <16 x float> %1006, %1006
  %1022 = fcmp contract olt <16 x float> %1020, %1021
  %1023 = bitcast <16 x i1> %1022 to i16
  %1024 = icmp eq i16 %1023, 0
  br i1 %1024, label %1238, label %1026

1025:
  br i1 %989, label %1026, label %1238

1026:
  %1027 = phi i64 [ %992, %998 ], [ %990, %1025 ]
  %1028 = getelementptr inbounds i8, ptr %993, i64 28
  %1029 = load float, ptr %1028, align 4
  %1030 = getelementptr inbounds i8, ptr %996, i64 28
  %1031 = load float, ptr %1030, align 4
  %1032 = fadd contract float %1029, %1031
  %1033 = insertelement <16 x float> poison, float %1032, i64 0
  %1034 = shufflevector <16 x float> %1033, <16 x float> poison, <16 x i32> zeroinitializer
  %1035 = fadd contract <16 x float> %771, %1034
  %1036 = fcmp contract ogt <16 x float> %1035, zeroinitializer
  %1037 = select contract <16 x i1> %1036, <16 x float> %1035, <16 x float> zeroinitializer
  %1038 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %992
  %1039 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %995
  %1040 = load <16 x float>, ptr %1038, align 64
  %1041 = load <16 x float>, ptr %1039, align 64
  %1042 = fsub contract <16 x float> %1040, %1041
  %1043 = getelementptr inbounds i8, ptr %1038, i64 64
  %1044 = load <16 x float>, ptr %1043, align 64
  %1045 = getelementptr inbounds i8, ptr %1039, i64 64
  %1046 = load <16 x float>, ptr %1045, align 64
  %1047 = fsub contract <16 x float> %1044, %1046
  %1048 = getelementptr inbounds i8, ptr %1038, i64 128
  %1049 = load <16 x float>, ptr %1048, align 64
  %1050 = getelementptr inbounds i8, ptr %1039, i64 128
  %1051 = load <16 x float>, ptr %1050, align 64
  %1052 = fsub contract <16 x float> %1049, %1051
  %1053 = fmul contract <16 x float> %1042, %1042
  %1054 = fmul contract <16 x float> %1047, %1047
  %1055 = fadd contract <16 x float> %1053, %1054
  %1056 = fmul contract <16 x float> %1052, %1052
  %1057 = fadd contract <16 x float> %1055, %1056
  %1058 = fmul contract <16 x float> %1037, %1037
  %1059 = fcmp contract olt <16 x float> %1057, %1058
  %1060 = bitcast <16 x i1> %1059 to i16
  %1061 = icmp eq i16 %1060, 0
  br i1 %1061, label %1238, label %1062

1062:
  %1063 = getelementptr inbounds i8, ptr %993, i64 24
  %1064 = load float, ptr %1063, align 4
  %1065 = getelementptr inbounds i8, ptr %996, i64 24
  %1066 = load float, ptr %1065, align 4
  %1067 = fadd contract float %1064, %1066
  %1068 = insertelement <16 x float> poison, float %1067, i64 0
  %1069 = shufflevector <16 x float> %1068, <16 x float> poison, <16 x i32> zeroinitializer
  %1070 = fadd contract <16 x float> %771, %1069
  %1071 = fcmp contract ogt <16 x float> %1070, zeroinitializer
  %1072 = select contract <16 x i1> %1071, <16 x float> %1070, <16 x float> zeroinitializer
  %1073 = getelementptr inbounds i8, ptr %993, i64 12
  %1074 = load float, ptr %1073, align 4
  %1075 = fmul contract float %1074, %1074
  %1076 = getelementptr inbounds i8, ptr %993, i64 16
  %1077 = load float, ptr %1076, align 4
  %1078 = fmul contract float %1077, %1077
  %1079 = fadd contract float %1075, %1078
  %1080 = getelementptr inbounds i8, ptr %993, i64 20
  %1081 = load float, ptr %1080, align 4
  %1082 = fmul contract float %1081, %1081
  %1083 = fadd contract float %1079, %1082
  %1084 = getelementptr inbounds i8, ptr %996, i64 12
  %1085 = load float, ptr %1084, align 4
  %1086 = fmul contract float %1085, %1085
  %1087 = getelementptr inbounds i8, ptr %996, i64 16
  %1088 = load float, ptr %1087, align 4
  %1089 = fmul contract float %1088, %1088
  %1090 = fadd contract float %1086, %1089
  %1091 = getelementptr inbounds i8, ptr %996, i64 20
  %1092 = load float, ptr %1091, align 4
  %1093 = fmul contract float %1092, %1092
  %1094 = fadd contract float %1090, %1093
  %1095 = fcmp contract oeq float %1083, 0.000000e+00
  %1096 = fcmp contract oeq float %1094, 0.000000e+00
  %1097 = select i1 %1095, i1 %1096, i1 false
  br i1 %1097, label %1229, label %1098

1098:
  %1099 = fmul contract <16 x float> %1040, zeroinitializer
  %1100 = fadd contract <16 x float> %1099, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %1101 = insertelement <16 x float> poison, float %1074, i64 0
  %1102 = shufflevector <16 x float> %1101, <16 x float> poison, <16 x i32> zeroinitializer
  %1103 = fmul contract <16 x float> %841, %1102
  %1104 = insertelement <16 x float> poison, float %1077, i64 0
  %1105 = shufflevector <16 x float> %1104, <16 x float> poison, <16 x i32> zeroinitializer
  %1106 = fmul contract <16 x float> %847, %1105
  %1107 = fadd contract <16 x float> %1103, %1106
  %1108 = insertelement <16 x float> poison, float %1081, i64 0
  %1109 = shufflevector <16 x float> %1108, <16 x float> poison, <16 x i32> zeroinitializer
  %1110 = fmul contract <16 x float> %853, %1109
  %1111 = fadd contract <16 x float> %1107, %1110
  %1112 = fmul contract <16 x float> %861, %1102
  %1113 = fmul contract <16 x float> %865, %1105
  %1114 = fadd contract <16 x float> %1112, %1113
  %1115 = fmul contract <16 x float> %869, %1109
  %1116 = fadd contract <16 x float> %1114, %1115
  %1117 = fmul contract <16 x float> %875, %1102
  %1118 = fmul contract <16 x float> %879, %1105
  %1119 = fadd contract <16 x float> %1117, %1118
  %1120 = fmul contract <16 x float> %883, %1109
  %1121 = fadd contract <16 x float> %1119, %1120
  %1122 = insertelement <16 x float> poison, float %1085, i64 0
  %1123 = shufflevector <16 x float> %1122, <16 x float> poison, <16 x i32> zeroinitializer
  %1124 = fmul contract <16 x float> %779, %1123
  %1125 = insertelement <16 x float> poison, float %1088, i64 0
  %1126 = shufflevector <16 x float> %1125, <16 x float> poison, <16 x i32> zeroinitializer
  %1127 = fmul contract <16 x float> %785, %1126
  %1128 = fadd contract <16 x float> %1124, %1127
  %1129 = insertelement <16 x float> poison, float %1092, i64 0
  %1130 = shufflevector <16 x float> %1129, <16 x float> poison, <16 x i32> zeroinitializer
  %1131 = fmul contract <16 x float> %791, %1130
  %1132 = fadd contract <16 x float> %1128, %1131
  %1133 = fmul contract <16 x float> %799, %1123
  %1134 = fmul contract <16 x float> %803, %1126
  %1135 = fadd contract <16 x float> %1133, %1134
  %1136 = fmul contract <16 x float> %807, %1130
  %1137 = fadd contract <16 x float> %1135, %1136
  %1138 = fmul contract <16 x float> %813, %1123
  %1139 = fmul contract <16 x float> %817, %1126
  %1140 = fadd contract <16 x float> %1138, %1139
  %1141 = fmul contract <16 x float> %821, %1130
  %1142 = fadd contract <16 x float> %1140, %1141
  %1143 = fcmp contract ogt float %1083, 0.000000e+00
  %1144 = fdiv contract float 1.000000e+00, %1083
  %1145 = select contract i1 %1143, float %1144, float 0.000000e+00
  %1146 = fcmp contract ogt float %1094, 0.000000e+00
  %1147 = fdiv contract float 1.000000e+00, %1094
  %1148 = select contract i1 %1146, float %1147, float 0.000000e+00
  %1149 = fmul contract <16 x float> %1111, %1132
  %1150 = fmul contract <16 x float> %1116, %1137
  %1151 = fadd contract <16 x float> %1149, %1150
  %1152 = fmul contract <16 x float> %1121, %1142
  %1153 = fadd contract <16 x float> %1152, %1151
  %1154 = fmul contract <16 x float> %1042, %1111
  %1155 = fmul contract <16 x float> %1047, %1116
  %1156 = fadd contract <16 x float> %1154, %1155
  %1157 = fmul contract <16 x float> %1052, %1121
  %1158 = fadd contract <16 x float> %1157, %1156
  %1159 = fmul contract <16 x float> %1042, %1132
  %1160 = fmul contract <16 x float> %1047, %1137
  %1161 = fadd contract <16 x float> %1159, %1160
  %1162 = fmul contract <16 x float> %1052, %1142
  %1163 = fadd contract <16 x float> %1162, %1161
  %1164 = fmul contract float %1083, %1094
  %1165 = insertelement <16 x float> poison, float %1164, i64 0
  %1166 = shufflevector <16 x float> %1165, <16 x float> poison, <16 x i32> zeroinitializer
  %1167 = fmul contract <16 x float> %1153, %1153
  %1168 = fsub contract <16 x float> %1166, %1167
  %1169 = fmul contract float %1083, 0x3E7AD7F2A0000000
  %1170 = fmul contract float %1169, %1094
  %1171 = insertelement <16 x float> poison, float %1170, i64 0
  %1172 = shufflevector <16 x float> %1171, <16 x float> poison, <16 x i32> zeroinitializer
  %1173 = fcmp contract ogt <16 x float> %1168, %1172
  %1174 = fmul contract <16 x float> %1153, %1163
  %1175 = insertelement <16 x float> poison, float %1094, i64 0
  %1176 = shufflevector <16 x float> %1175, <16 x float> poison, <16 x i32> zeroinitializer
  %1177 = fmul contract <16 x float> %1176, %1158
  %1178 = fsub contract <16 x float> %1174, %1177
  %1179 = select contract <16 x i1> %1173, <16 x float> %1168, <16 x float> %1100
  %1180 = fdiv contract <16 x float> %1178, %1179
  %1181 = fneg contract <16 x float> %1100
  %1182 = fcmp contract ogt <16 x float> %1180, %1181
  %1183 = select contract <16 x i1> %1182, <16 x float> %1180, <16 x float> %1181
  %1184 = fcmp contract olt <16 x float> %1183, %1100
  %1185 = select contract <16 x i1> %1184, <16 x float> %1183, <16 x float> %1100
  %1186 = select contract <16 x i1> %1173, <16 x float> %1185, <16 x float> %1181
  %1187 = fmul contract <16 x float> %1153, %1186
  %1188 = fadd contract <16 x float> %1163, %1187
  %1189 = insertelement <16 x float> poison, float %1148, i64 0
  %1190 = shufflevector <16 x float> %1189, <16 x float> poison, <16 x i32> zeroinitializer
  %1191 = fmul contract <16 x float> %1190, %1188
  %1192 = fcmp contract ogt <16 x float> %1191, %1181
  %1193 = select contract <16 x i1> %1192, <16 x float> %1191, <16 x float> %1181
  %1194 = fcmp contract olt <16 x float> %1193, %1100
  %1195 = select contract <16 x i1> %1194, <16 x float> %1193, <16 x float> %1100
  %1196 = fmul contract <16 x float> %1153, %1195
  %1197 = fsub contract <16 x float> %1196, %1158
  %1198 = insertelement <16 x float> poison, float %1145, i64 0
  %1199 = shufflevector <16 x float> %1198, <16 x float> poison, <16 x i32> zeroinitializer
  %1200 = fmul contract <16 x float> %1199, %1197
  %1201 = fcmp contract ogt <16 x float> %1200, %1181
  %1202 = select contract <16 x i1> %1201, <16 x float> %1200, <16 x float> %1181
  %1203 = fcmp contract olt <16 x float> %1202, %1100
  %1204 = select contract <16 x i1> %1203, <16 x float> %1202, <16 x float> %1100
  %1205 = fmul contract <16 x float> %1153, %1204
  %1206 = fadd contract <16 x float> %1163, %1205
  %1207 = fmul contract <16 x float> %1190, %1206
  %1208 = fcmp contract ogt <16 x float> %1207, %1181
  %1209 = select contract <16 x i1> %1208, <16 x float> %1207, <16 x float> %1181
  %1210 = fcmp contract olt <16 x float> %1209, %1100
  %1211 = select contract <16 x i1> %1210, <16 x float> %1209, <16 x float> %1100
  %1212 = fmul contract <16 x float> %1111, %1204
  %1213 = fadd contract <16 x float> %1042, %1212
  %1214 = fmul contract <16 x float> %1132, %1211
  %1215 = fsub contract <16 x float> %1213, %1214
  %1216 = fmul contract <16 x float> %1116, %1204
  %1217 = fadd contract <16 x float> %1047, %1216
  %1218 = fmul contract <16 x float> %1137, %1211
  %1219 = fsub contract <16 x float> %1217, %1218
  %1220 = fmul contract <16 x float> %1121, %1204
  %1221 = fadd contract <16 x float> %1052, %1220
  %1222 = fmul contract <16 x float> %1142, %1211
  %1223 = fsub contract <16 x float> %1221, %1222
  %1224 = fmul contract <16 x float> %1215, %1215
  %1225 = fmul contract <16 x float> %1219, %1219
  %1226 = fadd contract <16 x float> %1224, %1225
  %1227 = fmul contract <16 x float> %1223, %1223
  %1228 = fadd contract <16 x float> %1227, %1226
  br label %1229

1229:
  %1230 = phi <16 x float> [ %1228, %1098 ], [ %1057, %1062 ]
  %1231 = fmul contract <16 x float> %1072, %1072
  %1232 = fcmp contract olt <16 x float> %1230, %1231
  %1233 = sext <16 x i1> %1232 to <16 x i32>
  %1234 = bitcast <16 x i1> %1232 to i16
  %1235 = icmp eq i16 %1234, 0
  br i1 %1235, label %1236, label %1251

1236:
  %1237 = or <16 x i32> %987, %1233
  br label %1238

1238:
  %1239 = phi i1 [ true, %1236 ], [ true, %1026 ], [ false, %1025 ], [ false, %998 ]
  %1240 = phi i64 [ %1027, %1236 ], [ %1027, %1026 ], [ %990, %1025 ], [ %992, %998 ]
  %1241 = phi <16 x i32> [ %1237, %1236 ], [ %987, %1026 ], [ %987, %1025 ], [ %987, %998 ]
  %1242 = add i64 %988, 1
  %1243 = icmp eq i64 %1242, %903
  br i1 %1243, label %1244, label %986

1244:
  %1245 = phi <16 x i32> [ %754, %899 ], [ %1241, %1238 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1246

1246:
  %1247 = phi <16 x i32> [ %1245, %1244 ], [ %754, %753 ]
  %1248 = phi i64 [ %983, %1244 ], [ %755, %753 ]
  %1249 = add nuw nsw i64 %756, 1
  %1250 = icmp eq i64 %1249, %23
  br i1 %1250, label %1252, label %753

1251:
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1252

1252:
  %1253 = phi <16 x i32> [ %1233, %1251 ], [ %752, %751 ], [ %1247, %1246 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %6)
  br label %1254

1254:
  %1255 = phi <16 x i32> [ %1253, %1252 ], [ %733, %729 ], [ %739, %737 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %12)
  call void @llvm.lifetime.end.p0(i64 8704, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 1088, ptr nonnull %10)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %9)
  %1256 = icmp ne <16 x i32> %1255, zeroinitializer
  %1257 = bitcast <16 x i1> %1256 to i16
  %1258 = icmp eq i16 %1257, 0
  br i1 %1258, label %163, label %1259

1259:
  %1260 = phi i1 [ true, %115 ], [ %165, %163 ], [ %168, %1254 ]
  call void @llvm.lifetime.end.p0(i64 1224, ptr nonnull %13)
  ret i1 %1260
}

declare void @llvm.lifetime.end.p0(i64 immarg, ptr nocapture)

define void @prove_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, double noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = load i64, ptr %0, align 8
  %9 = icmp sgt i64 %4, 0
  br i1 %9, label %11, label %10

10:
  ret void

11:
  %12 = phi i64 [ %20, %11 ], [ 0, %7 ]
  %13 = mul nsw i64 %12, %8
  %14 = getelementptr inbounds double, ptr %1, i64 %13
  %15 = getelementptr inbounds double, ptr %2, i64 %13
  %16 = getelementptr inbounds double, ptr %3, i64 %13
  %17 = tail call fastcc noundef zeroext i1 @_ZL10prove_edgeRK5SceneIdEPKdS4_S4_d(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef %14, ptr noundef %15, ptr noundef %16, double noundef %5)
  %18 = zext i1 %17 to i8
  %19 = getelementptr inbounds i8, ptr %6, i64 %12
  store i8 %18, ptr %19, align 1
  %20 = add nuw nsw i64 %12, 1
  %21 = icmp eq i64 %20, %4
  br i1 %21, label %10, label %11
}

define internal fastcc noundef zeroext i1 @_ZL10prove_edgeRK5SceneIdEPKdS4_S4_d(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, double noundef %4) unnamed_addr {
  %6 = alloca [192 x %struct.Point.7], align 64
  %7 = alloca [2 x i64], align 16
  %8 = alloca [9 x <8 x double>], align 64
  %9 = alloca [16 x <8 x double>], align 64
  %10 = alloca [17 x <8 x double>], align 64
  %11 = alloca [136 x <8 x double>], align 64
  %12 = alloca [17 x %struct.Frame.3], align 64
  %13 = alloca %struct.Motion.2, align 8
  %14 = alloca [4096 x %struct.Piece], align 16
  %15 = alloca [8 x %struct.Piece], align 16
  call void @llvm.lifetime.start.p0(i64 2448, ptr nonnull %13)
  %16 = getelementptr inbounds i8, ptr %13, i64 272
  %17 = load i64, ptr %0, align 8
  %18 = icmp slt i64 %17, 0
  br i1 %18, label %23, label %19

19:
  %20 = getelementptr inbounds i8, ptr %0, i64 112
  %21 = icmp eq i64 %17, 0
  %22 = load ptr, ptr %20, align 8
  br label %31

23:
  %24 = getelementptr inbounds i8, ptr %0, i64 16
  %25 = load i64, ptr %24, align 8
  %26 = icmp sgt i64 %25, 0
  br i1 %26, label %27, label %77

27:
  %28 = getelementptr inbounds i8, ptr %0, i64 120
  %29 = icmp sgt i64 %17, 0
  %30 = load ptr, ptr %28, align 8
  br label %54

31:
  %32 = phi i64 [ 0, %19 ], [ %52, %49 ]
  %33 = mul nuw nsw i64 %32, %17
  %34 = getelementptr inbounds double, ptr %22, i64 %33
  br i1 %21, label %49, label %35

35:
  %36 = phi i64 [ %47, %35 ], [ 0, %31 ]
  %37 = phi double [ %46, %35 ], [ 0.000000e+00, %31 ]
  %38 = getelementptr inbounds double, ptr %34, i64 %36
  %39 = load double, ptr %38, align 8
  %40 = getelementptr inbounds double, ptr %2, i64 %36
  %41 = load double, ptr %40, align 8
  %42 = fcmp contract olt double %41, 0.000000e+00
  %43 = fneg contract double %41
  %44 = select contract i1 %42, double %43, double %41
  %45 = fmul contract double %39, %44
  %46 = fadd contract double %37, %45
  %47 = add nuw nsw i64 %36, 1
  %48 = icmp eq i64 %47, %17
  br i1 %48, label %49, label %35

49:
  %50 = phi double [ 0.000000e+00, %31 ], [ %46, %35 ]
  %51 = getelementptr inbounds double, ptr %13, i64 %32
  store double %50, ptr %51, align 8
  %52 = add nuw i64 %32, 1
  %53 = icmp eq i64 %32, %17
  br i1 %53, label %23, label %31

54:
  %55 = phi i64 [ 0, %27 ], [ %75, %72 ]
  %56 = mul nsw i64 %55, %17
  %57 = getelementptr inbounds double, ptr %30, i64 %56
  br i1 %29, label %58, label %72

58:
  %59 = phi i64 [ %70, %58 ], [ 0, %54 ]
  %60 = phi double [ %69, %58 ], [ 0.000000e+00, %54 ]
  %61 = getelementptr inbounds double, ptr %57, i64 %59
  %62 = load double, ptr %61, align 8
  %63 = getelementptr inbounds double, ptr %2, i64 %59
  %64 = load double, ptr %63, align 8
  %65 = fcmp contract olt double %64, 0.000000e+00
  %66 = fneg contract double %64
  %67 = select contract i1 %65, double %66, double %64
  %68 = fmul contract double %62, %67
  %69 = fadd contract double %60, %68
  %70 = add nuw nsw i64 %59, 1
  %71 = icmp eq i64 %70, %17
  br i1 %71, label %72, label %58

72:
  %73 = phi double [ 0.000000e+00, %54 ], [ %69, %58 ]
  %74 = getelementptr inbounds double, ptr %16, i64 %55
  store double %73, ptr %74, align 8
  %75 = add nuw nsw i64 %55, 1
  %76 = icmp eq i64 %75, %25
  br i1 %76, label %77, label %54

77:
  %78 = getelementptr inbounds i8, ptr %13, i64 136
  %79 = getelementptr inbounds i8, ptr %13, i64 1360
  br i1 %18, label %84, label %80

80:
  %81 = getelementptr inbounds i8, ptr %0, i64 112
  %82 = icmp eq i64 %17, 0
  %83 = load ptr, ptr %81, align 8
  br label %89

84:
  br i1 %26, label %85, label %135

85:
  %86 = getelementptr inbounds i8, ptr %0, i64 120
  %87 = icmp sgt i64 %17, 0
  %88 = load ptr, ptr %86, align 8
  br label %112

89:
  %90 = phi i64 [ 0, %80 ], [ %110, %107 ]
  %91 = mul nuw nsw i64 %90, %17
  %92 = getelementptr inbounds double, ptr %83, i64 %91
  br i1 %82, label %107, label %93

93:
  %94 = phi i64 [ %105, %93 ], [ 0, %89 ]
  %95 = phi double [ %104, %93 ], [ 0.000000e+00, %89 ]
  %96 = getelementptr inbounds double, ptr %92, i64 %94
  %97 = load double, ptr %96, align 8
  %98 = getelementptr inbounds double, ptr %3, i64 %94
  %99 = load double, ptr %98, align 8
  %100 = fcmp contract olt double %99, 0.000000e+00
  %101 = fneg contract double %99
  %102 = select contract i1 %100, double %101, double %99
  %103 = fmul contract double %97, %102
  %104 = fadd contract double %95, %103
  %105 = add nuw nsw i64 %94, 1
  %106 = icmp eq i64 %105, %17
  br i1 %106, label %107, label %93

107:
  %108 = phi double [ 0.000000e+00, %89 ], [ %104, %93 ]
  %109 = getelementptr inbounds double, ptr %78, i64 %90
  store double %108, ptr %109, align 8
  %110 = add nuw i64 %90, 1
  %111 = icmp eq i64 %90, %17
  br i1 %111, label %84, label %89

112:
  %113 = phi i64 [ 0, %85 ], [ %133, %130 ]
  %114 = mul nsw i64 %113, %17
  %115 = getelementptr inbounds double, ptr %88, i64 %114
  br i1 %87, label %116, label %130

116:
  %117 = phi i64 [ %128, %116 ], [ 0, %112 ]
  %118 = phi double [ %127, %116 ], [ 0.000000e+00, %112 ]
  %119 = getelementptr inbounds double, ptr %115, i64 %117
  %120 = load double, ptr %119, align 8
  %121 = getelementptr inbounds double, ptr %3, i64 %117
  %122 = load double, ptr %121, align 8
  %123 = fcmp contract olt double %122, 0.000000e+00
  %124 = fneg contract double %122
  %125 = select contract i1 %123, double %124, double %122
  %126 = fmul contract double %120, %125
  %127 = fadd contract double %118, %126
  %128 = add nuw nsw i64 %117, 1
  %129 = icmp eq i64 %128, %17
  br i1 %129, label %130, label %116

130:
  %131 = phi double [ 0.000000e+00, %112 ], [ %127, %116 ]
  %132 = getelementptr inbounds double, ptr %79, i64 %113
  store double %131, ptr %132, align 8
  %133 = add nuw nsw i64 %113, 1
  %134 = icmp eq i64 %133, %25
  br i1 %134, label %135, label %112

135:
  br i1 %18, label %136, label %138

136:
  %137 = phi double [ 0.000000e+00, %135 ], [ %144, %138 ]
  br i1 %26, label %147, label %156

138:
  %139 = phi i64 [ %145, %138 ], [ 0, %135 ]
  %140 = phi double [ %144, %138 ], [ 0.000000e+00, %135 ]
  %141 = getelementptr inbounds [17 x double], ptr %13, i64 0, i64 %139
  %142 = load double, ptr %141, align 8
  %143 = fcmp contract ogt double %142, %140
  %144 = select i1 %143, double %142, double %140
  %145 = add nuw i64 %139, 1
  %146 = icmp eq i64 %139, %17
  br i1 %146, label %136, label %138

147:
  %148 = phi i64 [ %154, %147 ], [ 0, %136 ]
  %149 = phi double [ %153, %147 ], [ %137, %136 ]
  %150 = getelementptr inbounds [136 x double], ptr %16, i64 0, i64 %148
  %151 = load double, ptr %150, align 8
  %152 = fcmp contract ogt double %151, %149
  %153 = select i1 %152, double %151, double %149
  %154 = add nuw nsw i64 %148, 1
  %155 = icmp eq i64 %154, %25
  br i1 %155, label %156, label %147

156:
  %157 = phi double [ %137, %136 ], [ %153, %147 ]
  call void @llvm.lifetime.start.p0(i64 65536, ptr nonnull %14)
  br label %190

158:
  %159 = icmp sgt i64 %17, 0
  %160 = getelementptr inbounds i8, ptr %0, i64 24
  %161 = load ptr, ptr %160, align 8
  %162 = getelementptr inbounds i8, ptr %12, i64 576
  %163 = icmp slt i64 %17, 1
  %164 = getelementptr inbounds i8, ptr %0, i64 48
  %165 = load ptr, ptr %164, align 8
  %166 = getelementptr inbounds i8, ptr %0, i64 8
  %167 = load i64, ptr %166, align 8
  %168 = icmp sgt i64 %167, 0
  %169 = getelementptr inbounds i8, ptr %0, i64 56
  %170 = load ptr, ptr %169, align 8
  %171 = getelementptr inbounds i8, ptr %0, i64 64
  %172 = load ptr, ptr %171, align 8
  %173 = getelementptr inbounds i8, ptr %0, i64 32
  %174 = load ptr, ptr %173, align 8
  %175 = getelementptr inbounds i8, ptr %0, i64 40
  %176 = load ptr, ptr %175, align 8
  %177 = getelementptr inbounds i8, ptr %0, i64 96
  %178 = load ptr, ptr %177, align 8
  %179 = getelementptr inbounds i8, ptr %0, i64 88
  %180 = load ptr, ptr %179, align 8
  %181 = getelementptr inbounds i8, ptr %0, i64 128
  %182 = load ptr, ptr %181, align 8
  %183 = getelementptr inbounds i8, ptr %7, i64 8
  %184 = getelementptr inbounds i8, ptr %0, i64 80
  %185 = load ptr, ptr %184, align 8
  %186 = getelementptr inbounds i8, ptr %0, i64 72
  %187 = load ptr, ptr %186, align 8
  %188 = getelementptr inbounds i8, ptr %0, i64 104
  %189 = load ptr, ptr %188, align 8
  br label %200

190:
  %191 = phi i64 [ 0, %156 ], [ %196, %190 ]
  %192 = uitofp nneg i64 %191 to double
  %193 = fmul contract double %192, 2.000000e+00
  %194 = fadd contract double %193, 1.000000e+00
  %195 = fmul contract double %194, 6.250000e-02
  %196 = add nuw nsw i64 %191, 1
  %197 = getelementptr inbounds [4096 x %struct.Piece], ptr %14, i64 0, i64 %191
  store double %195, ptr %197, align 16
  %198 = getelementptr inbounds i8, ptr %197, i64 8
  store double 6.250000e-02, ptr %198, align 8
  %199 = icmp eq i64 %196, 8
  br i1 %199, label %158, label %190

200:
  %201 = phi i64 [ 8, %158 ], [ %1344, %1343 ]
  %202 = phi <8 x double> [ undef, %158 ], [ %1307, %1343 ]
  %203 = phi <8 x double> [ undef, %158 ], [ %1310, %1343 ]
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %15)
  br label %1296

204:
  %205 = tail call i64 @llvm.smin.i64(i64 %201, i64 8)
  %206 = sub nsw i64 %201, %205
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 1088, ptr nonnull %10)
  call void @llvm.lifetime.start.p0(i64 8704, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %12)
  br i1 %159, label %429, label %207

207:
  br label %208

208:
  %209 = phi i64 [ %216, %208 ], [ 0, %207 ]
  %210 = and i64 %209, 3
  %211 = icmp eq i64 %210, 0
  %212 = uitofp i1 %211 to double
  %213 = insertelement <8 x double> poison, double %212, i64 0
  %214 = shufflevector <8 x double> %213, <8 x double> poison, <8 x i32> zeroinitializer
  %215 = getelementptr inbounds [9 x <8 x double>], ptr %12, i64 0, i64 %209
  store <8 x double> %214, ptr %215, align 64
  %216 = add nuw nsw i64 %209, 1
  %217 = icmp eq i64 %216, 9
  br i1 %217, label %219, label %208

218:
  br i1 %159, label %225, label %444

219:
  %220 = phi i64 [ %222, %219 ], [ 0, %208 ]
  %221 = getelementptr inbounds [3 x <8 x double>], ptr %162, i64 0, i64 %220
  store <8 x double> zeroinitializer, ptr %221, align 64
  %222 = add nuw nsw i64 %220, 1
  %223 = icmp eq i64 %222, 3
  br i1 %223, label %218, label %219

224:
  br i1 %163, label %444, label %445

225:
  %226 = phi i64 [ %229, %427 ], [ 0, %218 ]
  %227 = getelementptr inbounds %struct.Joint.6, ptr %161, i64 %226
  %228 = getelementptr inbounds %struct.Frame.3, ptr %12, i64 %226
  %229 = add nuw nsw i64 %226, 1
  %230 = getelementptr inbounds <8 x double>, ptr %9, i64 %226
  %231 = load <8 x double>, ptr %230, align 64
  %232 = getelementptr inbounds i8, ptr %227, i64 72
  %233 = load double, ptr %232, align 8
  %234 = getelementptr inbounds i8, ptr %227, i64 80
  %235 = load double, ptr %234, align 8
  %236 = getelementptr inbounds i8, ptr %227, i64 88
  %237 = load double, ptr %236, align 8
  %238 = getelementptr inbounds i8, ptr %228, i64 576
  %239 = load <8 x double>, ptr %238, align 64
  %240 = load <8 x double>, ptr %228, align 64
  %241 = insertelement <8 x double> poison, double %233, i64 0
  %242 = shufflevector <8 x double> %241, <8 x double> poison, <8 x i32> zeroinitializer
  %243 = fmul contract <8 x double> %242, %240
  %244 = getelementptr inbounds i8, ptr %228, i64 64
  %245 = load <8 x double>, ptr %244, align 64
  %246 = insertelement <8 x double> poison, double %235, i64 0
  %247 = shufflevector <8 x double> %246, <8 x double> poison, <8 x i32> zeroinitializer
  %248 = fmul contract <8 x double> %247, %245
  %249 = getelementptr inbounds i8, ptr %228, i64 128
  %250 = load <8 x double>, ptr %249, align 64
  %251 = insertelement <8 x double> poison, double %237, i64 0
  %252 = shufflevector <8 x double> %251, <8 x double> poison, <8 x i32> zeroinitializer
  %253 = fmul contract <8 x double> %252, %250
  %254 = getelementptr inbounds i8, ptr %228, i64 640
  %255 = load <8 x double>, ptr %254, align 64
  %256 = getelementptr inbounds i8, ptr %228, i64 192
  %257 = load <8 x double>, ptr %256, align 64
  %258 = fmul contract <8 x double> %242, %257
  %259 = getelementptr inbounds i8, ptr %228, i64 256
  %260 = load <8 x double>, ptr %259, align 64
  %261 = fmul contract <8 x double> %247, %260
  %262 = getelementptr inbounds i8, ptr %228, i64 320
  %263 = load <8 x double>, ptr %262, align 64
  %264 = fmul contract <8 x double> %252, %263
  %265 = getelementptr inbounds i8, ptr %228, i64 704
  %266 = load <8 x double>, ptr %265, align 64
  %267 = getelementptr inbounds i8, ptr %228, i64 384
  %268 = load <8 x double>, ptr %267, align 64
  %269 = fmul contract <8 x double> %242, %268
  %270 = getelementptr inbounds i8, ptr %228, i64 448
  %271 = load <8 x double>, ptr %270, align 64
  %272 = fmul contract <8 x double> %247, %271
  %273 = getelementptr inbounds i8, ptr %228, i64 512
  %274 = load <8 x double>, ptr %273, align 64
  %275 = fmul contract <8 x double> %252, %274
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %8)
  br label %276

276:
  %277 = phi i64 [ 0, %225 ], [ %305, %304 ]
  %278 = mul nuw nsw i64 %277, 3
  %279 = getelementptr inbounds [9 x <8 x double>], ptr %228, i64 0, i64 %278
  %280 = load <8 x double>, ptr %279, align 64
  %281 = add nuw nsw i64 %278, 1
  %282 = getelementptr inbounds [9 x <8 x double>], ptr %228, i64 0, i64 %281
  %283 = load <8 x double>, ptr %282, align 64
  %284 = add nuw nsw i64 %278, 2
  %285 = getelementptr inbounds [9 x <8 x double>], ptr %228, i64 0, i64 %284
  %286 = load <8 x double>, ptr %285, align 64
  br label %307

287:
  %288 = getelementptr inbounds %struct.Frame.3, ptr %12, i64 %229
  %289 = fadd contract <8 x double> %239, %243
  %290 = fadd contract <8 x double> %289, %248
  %291 = fadd contract <8 x double> %290, %253
  %292 = fadd contract <8 x double> %255, %258
  %293 = fadd contract <8 x double> %292, %261
  %294 = fadd contract <8 x double> %293, %264
  %295 = fadd contract <8 x double> %266, %269
  %296 = fadd contract <8 x double> %295, %272
  %297 = fadd contract <8 x double> %296, %275
  %298 = getelementptr inbounds i8, ptr %288, i64 576
  store <8 x double> %291, ptr %298, align 64
  %299 = getelementptr inbounds i8, ptr %288, i64 640
  store <8 x double> %294, ptr %299, align 64
  %300 = getelementptr inbounds i8, ptr %288, i64 704
  store <8 x double> %297, ptr %300, align 64
  %301 = getelementptr inbounds i8, ptr %227, i64 96
  %302 = load double, ptr %301, align 8
  %303 = fcmp contract une double %302, 0.000000e+00
  br i1 %303, label %332, label %351

304:
  %305 = add nuw nsw i64 %277, 1
  %306 = icmp eq i64 %305, 3
  br i1 %306, label %287, label %276

307:
  %308 = phi i64 [ 0, %276 ], [ %330, %307 ]
  %309 = getelementptr inbounds [9 x double], ptr %227, i64 0, i64 %308
  %310 = load double, ptr %309, align 8
  %311 = insertelement <8 x double> poison, double %310, i64 0
  %312 = shufflevector <8 x double> %311, <8 x double> poison, <8 x i32> zeroinitializer
  %313 = fmul contract <8 x double> %280, %312
  %314 = add nuw nsw i64 %308, 3
  %315 = getelementptr inbounds [9 x double], ptr %227, i64 0, i64 %314
  %316 = load double, ptr %315, align 8
  %317 = insertelement <8 x double> poison, double %316, i64 0
  %318 = shufflevector <8 x double> %317, <8 x double> poison, <8 x i32> zeroinitializer
  %319 = fmul contract <8 x double> %283, %318
  %320 = fadd contract <8 x double> %313, %319
  %321 = add nuw nsw i64 %308, 6
  %322 = getelementptr inbounds [9 x double], ptr %227, i64 0, i64 %321
  %323 = load double, ptr %322, align 8
  %324 = insertelement <8 x double> poison, double %323, i64 0
  %325 = shufflevector <8 x double> %324, <8 x double> poison, <8 x i32> zeroinitializer
  %326 = fmul contract <8 x double> %286, %325
  %327 = fadd contract <8 x double> %320, %326
  %328 = add nuw nsw i64 %308, %278
  %329 = getelementptr inbounds [9 x <8 x double>], ptr %8, i64 0, i64 %328
  store <8 x double> %327, ptr %329, align 64
  %330 = add nuw nsw i64 %308, 1
  %331 = icmp eq i64 %330, 3
  br i1 %331, label %304, label %307

332:
  %333 = phi i64 [ %337, %332 ], [ 0, %287 ]
  %334 = getelementptr inbounds [9 x <8 x double>], ptr %8, i64 0, i64 %333
  %335 = load <8 x double>, ptr %334, align 64
  %336 = getelementptr inbounds [9 x <8 x double>], ptr %288, i64 0, i64 %333
  store <8 x double> %335, ptr %336, align 64
  %337 = add nuw nsw i64 %333, 1
  %338 = icmp eq i64 %337, 9
  br i1 %338, label %339, label %332

339:
  %340 = phi i64 [ %349, %339 ], [ 0, %332 ]
  %341 = mul nuw nsw i64 %340, 3
  %342 = add nuw nsw i64 %341, 2
  %343 = getelementptr inbounds [9 x <8 x double>], ptr %8, i64 0, i64 %342
  %344 = load <8 x double>, ptr %343, align 64
  %345 = fmul contract <8 x double> %231, %344
  %346 = getelementptr inbounds [3 x <8 x double>], ptr %298, i64 0, i64 %340
  %347 = load <8 x double>, ptr %346, align 64
  %348 = fadd contract <8 x double> %347, %345
  store <8 x double> %348, ptr %346, align 64
  %349 = add nuw nsw i64 %340, 1
  %350 = icmp eq i64 %349, 3
  br i1 %350, label %427, label %339

351:
  %352 = fmul contract <8 x double> %231, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %353 = fadd contract <8 x double> %352, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %354 = fadd contract <8 x double> %353, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %355 = fmul contract <8 x double> %354, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %356 = fsub contract <8 x double> %231, %355
  %357 = fmul contract <8 x double> %354, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %358 = fsub contract <8 x double> %356, %357
  %359 = fmul contract <8 x double> %354, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %360 = fsub contract <8 x double> %358, %359
  %361 = fmul contract <8 x double> %354, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %362 = fadd contract <8 x double> %361, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %363 = fadd contract <8 x double> %362, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %364 = fsub contract <8 x double> %361, %363
  %365 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %364)
  %366 = fmul contract <8 x double> %365, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %367 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %366
  %368 = fmul contract <8 x double> %360, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %369 = fmul contract <8 x double> %368, %368
  %370 = fmul contract <8 x double> %368, %369
  %371 = fmul contract <8 x double> %369, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %372 = fadd contract <8 x double> %371, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %373 = fmul contract <8 x double> %369, %372
  %374 = fadd contract <8 x double> %373, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %375 = fmul contract <8 x double> %369, %374
  %376 = fadd contract <8 x double> %375, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %377 = fmul contract <8 x double> %369, %376
  %378 = fadd contract <8 x double> %377, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %379 = fmul contract <8 x double> %369, %378
  %380 = fadd contract <8 x double> %379, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %381 = fmul contract <8 x double> %370, %380
  %382 = fadd contract <8 x double> %368, %381
  %383 = fmul contract <8 x double> %369, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %384 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %383
  %385 = fmul contract <8 x double> %369, %369
  %386 = fmul contract <8 x double> %369, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %387 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %386
  %388 = fmul contract <8 x double> %369, %387
  %389 = fadd contract <8 x double> %388, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %390 = fmul contract <8 x double> %369, %389
  %391 = fadd contract <8 x double> %390, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %392 = fmul contract <8 x double> %369, %391
  %393 = fadd contract <8 x double> %392, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %394 = fmul contract <8 x double> %369, %393
  %395 = fadd contract <8 x double> %394, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %396 = fmul contract <8 x double> %385, %395
  %397 = fadd contract <8 x double> %384, %396
  %398 = fmul contract <8 x double> %367, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %399 = fmul contract <8 x double> %398, %382
  %400 = fmul contract <8 x double> %397, %399
  %401 = fmul contract <8 x double> %382, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %402 = fmul contract <8 x double> %382, %401
  %403 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %402
  %404 = fmul contract <8 x double> %367, %403
  br label %405

405:
  %406 = phi i64 [ 0, %351 ], [ %425, %405 ]
  %407 = mul nuw nsw i64 %406, 3
  %408 = getelementptr inbounds [9 x <8 x double>], ptr %8, i64 0, i64 %407
  %409 = load <8 x double>, ptr %408, align 64
  %410 = fmul contract <8 x double> %404, %409
  %411 = add nuw nsw i64 %407, 1
  %412 = getelementptr inbounds [9 x <8 x double>], ptr %8, i64 0, i64 %411
  %413 = load <8 x double>, ptr %412, align 64
  %414 = fmul contract <8 x double> %400, %413
  %415 = fadd contract <8 x double> %410, %414
  %416 = getelementptr inbounds [9 x <8 x double>], ptr %288, i64 0, i64 %407
  store <8 x double> %415, ptr %416, align 64
  %417 = fmul contract <8 x double> %404, %413
  %418 = fmul contract <8 x double> %400, %409
  %419 = fsub contract <8 x double> %417, %418
  %420 = getelementptr inbounds [9 x <8 x double>], ptr %288, i64 0, i64 %411
  store <8 x double> %419, ptr %420, align 64
  %421 = add nuw nsw i64 %407, 2
  %422 = getelementptr inbounds [9 x <8 x double>], ptr %8, i64 0, i64 %421
  %423 = load <8 x double>, ptr %422, align 64
  %424 = getelementptr inbounds [9 x <8 x double>], ptr %288, i64 0, i64 %421
  store <8 x double> %423, ptr %424, align 64
  %425 = add nuw nsw i64 %406, 1
  %426 = icmp eq i64 %425, 3
  br i1 %426, label %427, label %405

427:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %8)
  %428 = icmp eq i64 %229, %17
  br i1 %428, label %224, label %225

429:
  %430 = phi i64 [ %442, %429 ], [ 0, %204 ]
  %431 = getelementptr inbounds double, ptr %1, i64 %430
  %432 = load double, ptr %431, align 8
  %433 = insertelement <8 x double> poison, double %432, i64 0
  %434 = shufflevector <8 x double> %433, <8 x double> poison, <8 x i32> zeroinitializer
  %435 = getelementptr inbounds double, ptr %2, i64 %430
  %436 = load double, ptr %435, align 8
  %437 = insertelement <8 x double> poison, double %436, i64 0
  %438 = shufflevector <8 x double> %437, <8 x double> poison, <8 x i32> zeroinitializer
  %439 = fmul contract <8 x double> %1307, %438
  %440 = fadd contract <8 x double> %434, %439
  %441 = getelementptr inbounds [16 x <8 x double>], ptr %9, i64 0, i64 %430
  store <8 x double> %440, ptr %441, align 64
  %442 = add nuw nsw i64 %430, 1
  %443 = icmp eq i64 %442, %17
  br i1 %443, label %207, label %429

444:
  br i1 %26, label %461, label %460

445:
  %446 = phi i64 [ %458, %445 ], [ 1, %224 ]
  %447 = getelementptr inbounds [17 x double], ptr %13, i64 0, i64 %446
  %448 = load double, ptr %447, align 8
  %449 = insertelement <8 x double> poison, double %448, i64 0
  %450 = shufflevector <8 x double> %449, <8 x double> poison, <8 x i32> zeroinitializer
  %451 = fmul contract <8 x double> %1310, %450
  %452 = getelementptr inbounds [17 x double], ptr %78, i64 0, i64 %446
  %453 = load double, ptr %452, align 8
  %454 = insertelement <8 x double> poison, double %453, i64 0
  %455 = shufflevector <8 x double> %454, <8 x double> poison, <8 x i32> zeroinitializer
  %456 = fadd contract <8 x double> %451, %455
  %457 = getelementptr inbounds [17 x <8 x double>], ptr %10, i64 0, i64 %446
  store <8 x double> %456, ptr %457, align 64
  %458 = add nuw i64 %446, 1
  %459 = icmp eq i64 %446, %17
  br i1 %459, label %444, label %445

460:
  br i1 %163, label %795, label %476

461:
  %462 = phi i64 [ %474, %461 ], [ 0, %444 ]
  %463 = getelementptr inbounds [136 x double], ptr %16, i64 0, i64 %462
  %464 = load double, ptr %463, align 8
  %465 = insertelement <8 x double> poison, double %464, i64 0
  %466 = shufflevector <8 x double> %465, <8 x double> poison, <8 x i32> zeroinitializer
  %467 = fmul contract <8 x double> %1310, %466
  %468 = getelementptr inbounds [136 x double], ptr %79, i64 0, i64 %462
  %469 = load double, ptr %468, align 8
  %470 = insertelement <8 x double> poison, double %469, i64 0
  %471 = shufflevector <8 x double> %470, <8 x double> poison, <8 x i32> zeroinitializer
  %472 = fadd contract <8 x double> %467, %471
  %473 = getelementptr inbounds [136 x <8 x double>], ptr %11, i64 0, i64 %462
  store <8 x double> %472, ptr %473, align 64
  %474 = add nuw nsw i64 %462, 1
  %475 = icmp eq i64 %474, %25
  br i1 %475, label %460, label %461

476:
  %477 = phi <8 x i64> [ %792, %791 ], [ zeroinitializer, %460 ]
  %478 = phi i64 [ %793, %791 ], [ 1, %460 ]
  %479 = getelementptr inbounds %struct.Sphere.8, ptr %165, i64 %478
  %480 = getelementptr inbounds i8, ptr %479, i64 24
  %481 = load double, ptr %480, align 8
  %482 = fcmp contract olt double %481, 0.000000e+00
  br i1 %482, label %791, label %483

483:
  %484 = getelementptr inbounds %struct.Frame.3, ptr %12, i64 %478
  %485 = load double, ptr %479, align 8
  %486 = getelementptr inbounds i8, ptr %479, i64 8
  %487 = load double, ptr %486, align 8
  %488 = getelementptr inbounds i8, ptr %479, i64 16
  %489 = load double, ptr %488, align 8
  %490 = getelementptr inbounds i8, ptr %484, i64 576
  %491 = load <8 x double>, ptr %490, align 64
  %492 = load <8 x double>, ptr %484, align 64
  %493 = insertelement <8 x double> poison, double %485, i64 0
  %494 = shufflevector <8 x double> %493, <8 x double> poison, <8 x i32> zeroinitializer
  %495 = fmul contract <8 x double> %494, %492
  %496 = fadd contract <8 x double> %491, %495
  %497 = getelementptr inbounds i8, ptr %484, i64 64
  %498 = load <8 x double>, ptr %497, align 64
  %499 = insertelement <8 x double> poison, double %487, i64 0
  %500 = shufflevector <8 x double> %499, <8 x double> poison, <8 x i32> zeroinitializer
  %501 = fmul contract <8 x double> %500, %498
  %502 = fadd contract <8 x double> %496, %501
  %503 = getelementptr inbounds i8, ptr %484, i64 128
  %504 = load <8 x double>, ptr %503, align 64
  %505 = insertelement <8 x double> poison, double %489, i64 0
  %506 = shufflevector <8 x double> %505, <8 x double> poison, <8 x i32> zeroinitializer
  %507 = fmul contract <8 x double> %506, %504
  %508 = fadd contract <8 x double> %502, %507
  %509 = getelementptr inbounds i8, ptr %484, i64 640
  %510 = load <8 x double>, ptr %509, align 64
  %511 = getelementptr inbounds i8, ptr %484, i64 192
  %512 = load <8 x double>, ptr %511, align 64
  %513 = fmul contract <8 x double> %494, %512
  %514 = fadd contract <8 x double> %510, %513
  %515 = getelementptr inbounds i8, ptr %484, i64 256
  %516 = load <8 x double>, ptr %515, align 64
  %517 = fmul contract <8 x double> %500, %516
  %518 = fadd contract <8 x double> %514, %517
  %519 = getelementptr inbounds i8, ptr %484, i64 320
  %520 = load <8 x double>, ptr %519, align 64
  %521 = fmul contract <8 x double> %506, %520
  %522 = fadd contract <8 x double> %518, %521
  %523 = getelementptr inbounds i8, ptr %484, i64 704
  %524 = load <8 x double>, ptr %523, align 64
  %525 = getelementptr inbounds i8, ptr %484, i64 384
  %526 = load <8 x double>, ptr %525, align 64
  %527 = fmul contract <8 x double> %494, %526
  %528 = fadd contract <8 x double> %524, %527
  %529 = getelementptr inbounds i8, ptr %484, i64 448
  %530 = load <8 x double>, ptr %529, align 64
  %531 = fmul contract <8 x double> %500, %530
  %532 = fadd contract <8 x double> %528, %531
  %533 = getelementptr inbounds i8, ptr %484, i64 512
  %534 = load <8 x double>, ptr %533, align 64
  %535 = fmul contract <8 x double> %506, %534
  %536 = fadd contract <8 x double> %532, %535
  %537 = getelementptr inbounds <8 x double>, ptr %10, i64 %478
  %538 = load <8 x double>, ptr %537, align 64
  br i1 %168, label %539, label %791

539:
  %540 = mul nuw nsw i64 %167, %478
  %541 = getelementptr double, ptr %172, i64 %540
  %542 = getelementptr inbounds i64, ptr %174, i64 %478
  %543 = getelementptr inbounds i8, ptr %542, i64 8
  br label %544

544:
  %545 = phi <8 x i64> [ %477, %539 ], [ %788, %787 ]
  %546 = phi i64 [ 0, %539 ], [ %789, %787 ]
  %547 = getelementptr inbounds %struct.Object.9, ptr %170, i64 %546
  %548 = getelementptr double, ptr %541, i64 %546
  %549 = load double, ptr %548, align 8
  %550 = getelementptr inbounds i8, ptr %547, i64 120
  %551 = load double, ptr %550, align 8
  %552 = fadd contract double %549, %551
  %553 = fcmp contract olt double %552, -1.000000e+08
  br i1 %553, label %787, label %554

554:
  %555 = fadd contract double %481, %552
  %556 = insertelement <8 x double> poison, double %555, i64 0
  %557 = shufflevector <8 x double> %556, <8 x double> poison, <8 x i32> zeroinitializer
  %558 = fadd contract <8 x double> %538, %557
  %559 = fcmp contract ogt <8 x double> %558, zeroinitializer
  %560 = select contract <8 x i1> %559, <8 x double> %558, <8 x double> zeroinitializer
  %561 = getelementptr inbounds i8, ptr %547, i64 72
  %562 = load double, ptr %561, align 8
  %563 = insertelement <8 x double> poison, double %562, i64 0
  %564 = shufflevector <8 x double> %563, <8 x double> poison, <8 x i32> zeroinitializer
  %565 = load double, ptr %547, align 8
  %566 = insertelement <8 x double> poison, double %565, i64 0
  %567 = shufflevector <8 x double> %566, <8 x double> poison, <8 x i32> zeroinitializer
  %568 = fmul contract <8 x double> %508, %567
  %569 = fadd contract <8 x double> %564, %568
  %570 = getelementptr inbounds i8, ptr %547, i64 8
  %571 = load double, ptr %570, align 8
  %572 = insertelement <8 x double> poison, double %571, i64 0
  %573 = shufflevector <8 x double> %572, <8 x double> poison, <8 x i32> zeroinitializer
  %574 = fmul contract <8 x double> %522, %573
  %575 = fadd contract <8 x double> %569, %574
  %576 = getelementptr inbounds i8, ptr %547, i64 16
  %577 = load double, ptr %576, align 8
  %578 = insertelement <8 x double> poison, double %577, i64 0
  %579 = shufflevector <8 x double> %578, <8 x double> poison, <8 x i32> zeroinitializer
  %580 = fmul contract <8 x double> %536, %579
  %581 = fadd contract <8 x double> %575, %580
  %582 = getelementptr inbounds i8, ptr %547, i64 80
  %583 = load double, ptr %582, align 8
  %584 = insertelement <8 x double> poison, double %583, i64 0
  %585 = shufflevector <8 x double> %584, <8 x double> poison, <8 x i32> zeroinitializer
  %586 = getelementptr inbounds i8, ptr %547, i64 24
  %587 = load double, ptr %586, align 8
  %588 = insertelement <8 x double> poison, double %587, i64 0
  %589 = shufflevector <8 x double> %588, <8 x double> poison, <8 x i32> zeroinitializer
  %590 = fmul contract <8 x double> %508, %589
  %591 = fadd contract <8 x double> %585, %590
  %592 = getelementptr inbounds i8, ptr %547, i64 32
  %593 = load double, ptr %592, align 8
  %594 = insertelement <8 x double> poison, double %593, i64 0
  %595 = shufflevector <8 x double> %594, <8 x double> poison, <8 x i32> zeroinitializer
  %596 = fmul contract <8 x double> %522, %595
  %597 = fadd contract <8 x double> %591, %596
  %598 = getelementptr inbounds i8, ptr %547, i64 40
  %599 = load double, ptr %598, align 8
  %600 = insertelement <8 x double> poison, double %599, i64 0
  %601 = shufflevector <8 x double> %600, <8 x double> poison, <8 x i32> zeroinitializer
  %602 = fmul contract <8 x double> %536, %601
  %603 = fadd contract <8 x double> %597, %602
  %604 = getelementptr inbounds i8, ptr %547, i64 88
  %605 = load double, ptr %604, align 8
  %606 = insertelement <8 x double> poison, double %605, i64 0
  %607 = shufflevector <8 x double> %606, <8 x double> poison, <8 x i32> zeroinitializer
  %608 = getelementptr inbounds i8, ptr %547, i64 48
  %609 = load double, ptr %608, align 8
  %610 = insertelement <8 x double> poison, double %609, i64 0
  %611 = shufflevector <8 x double> %610, <8 x double> poison, <8 x i32> zeroinitializer
  %612 = fmul contract <8 x double> %508, %611
  %613 = fadd contract <8 x double> %607, %612
  %614 = getelementptr inbounds i8, ptr %547, i64 56
  %615 = load double, ptr %614, align 8
  %616 = insertelement <8 x double> poison, double %615, i64 0
  %617 = shufflevector <8 x double> %616, <8 x double> poison, <8 x i32> zeroinitializer
  %618 = fmul contract <8 x double> %522, %617
  %619 = fadd contract <8 x double> %613, %618
  %620 = getelementptr inbounds i8, ptr %547, i64 64
  %621 = load double, ptr %620, align 8
  %622 = insertelement <8 x double> poison, double %621, i64 0
  %623 = shufflevector <8 x double> %622, <8 x double> poison, <8 x i32> zeroinitializer
  %624 = fmul contract <8 x double> %536, %623
  %625 = fadd contract <8 x double> %619, %624
  %626 = fmul contract <8 x double> %581, zeroinitializer
  %627 = getelementptr inbounds i8, ptr %547, i64 136
  %628 = load double, ptr %627, align 8
  %629 = fcmp contract une double %628, 0.000000e+00
  %630 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %625)
  %631 = select contract i1 %629, <8 x double> %625, <8 x double> %630
  %632 = getelementptr inbounds i8, ptr %547, i64 128
  %633 = load double, ptr %632, align 8
  %634 = fcmp contract une double %633, 0.000000e+00
  br i1 %634, label %635, label %640

635:
  %636 = fmul contract <8 x double> %581, %581
  %637 = fmul contract <8 x double> %603, %603
  %638 = fadd contract <8 x double> %636, %637
  %639 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %638)
  br label %642

640:
  %641 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %581)
  br label %642

642:
  %643 = phi contract <8 x double> [ %639, %635 ], [ %641, %640 ]
  %644 = getelementptr inbounds i8, ptr %547, i64 96
  %645 = load double, ptr %644, align 8
  %646 = insertelement <8 x double> poison, double %645, i64 0
  %647 = shufflevector <8 x double> %646, <8 x double> poison, <8 x i32> zeroinitializer
  %648 = fsub contract <8 x double> %643, %647
  %649 = fcmp contract ogt <8 x double> %648, %626
  %650 = select contract <8 x i1> %649, <8 x double> %648, <8 x double> %626
  %651 = getelementptr inbounds i8, ptr %547, i64 112
  %652 = load double, ptr %651, align 8
  %653 = insertelement <8 x double> poison, double %652, i64 0
  %654 = shufflevector <8 x double> %653, <8 x double> poison, <8 x i32> zeroinitializer
  %655 = fsub contract <8 x double> %631, %654
  %656 = fcmp contract ogt <8 x double> %655, %626
  %657 = select contract <8 x i1> %656, <8 x double> %655, <8 x double> %626
  %658 = fmul contract <8 x double> %650, %650
  %659 = fmul contract <8 x double> %657, %657
  %660 = fadd contract <8 x double> %658, %659
  br i1 %634, label %672, label %661

661:
  %662 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %603)
  %663 = getelementptr inbounds i8, ptr %547, i64 104
  %664 = load double, ptr %663, align 8
  %665 = insertelement <8 x double> poison, double %664, i64 0
  %666 = shufflevector <8 x double> %665, <8 x double> poison, <8 x i32> zeroinitializer
  %667 = fsub contract <8 x double> %662, %666
  %668 = fcmp contract ogt <8 x double> %667, %626
  %669 = select contract <8 x i1> %668, <8 x double> %667, <8 x double> %626
  %670 = fmul contract <8 x double> %669, %669
  %671 = fadd contract <8 x double> %660, %670
  br label %672

672:
  %673 = phi <8 x double> [ %671, %661 ], [ %660, %642 ]
  %674 = fmul contract <8 x double> %560, %560
  %675 = fcmp contract olt <8 x double> %673, %674
  %676 = bitcast <8 x i1> %675 to i8
  %677 = icmp eq i8 %676, 0
  br i1 %677, label %787, label %678

678:
  %679 = load i64, ptr %542, align 8
  %680 = load i64, ptr %543, align 8
  %681 = icmp slt i64 %679, %680
  br i1 %681, label %682, label %684

682:
  %683 = getelementptr inbounds i8, ptr %547, i64 104
  br label %690

684:
  %685 = phi <8 x i64> [ zeroinitializer, %678 ], [ %784, %780 ]
  %686 = or <8 x i64> %685, %545
  %687 = icmp eq <8 x i64> %686, zeroinitializer
  %688 = bitcast <8 x i1> %687 to i8
  %689 = icmp eq i8 %688, 0
  br i1 %689, label %1293, label %787

690:
  %691 = phi <8 x i64> [ zeroinitializer, %682 ], [ %784, %780 ]
  %692 = phi i64 [ %679, %682 ], [ %785, %780 ]
  %693 = getelementptr inbounds %struct.Sphere.8, ptr %176, i64 %692
  %694 = getelementptr inbounds i8, ptr %693, i64 24
  %695 = load double, ptr %694, align 8
  %696 = fadd contract double %552, %695
  %697 = insertelement <8 x double> poison, double %696, i64 0
  %698 = shufflevector <8 x double> %697, <8 x double> poison, <8 x i32> zeroinitializer
  %699 = fadd contract <8 x double> %538, %698
  %700 = fcmp contract ogt <8 x double> %699, zeroinitializer
  %701 = select contract <8 x i1> %700, <8 x double> %699, <8 x double> zeroinitializer
  %702 = load double, ptr %693, align 8
  %703 = getelementptr inbounds i8, ptr %693, i64 8
  %704 = load double, ptr %703, align 8
  %705 = getelementptr inbounds i8, ptr %693, i64 16
  %706 = load double, ptr %705, align 8
  %707 = insertelement <8 x double> poison, double %702, i64 0
  %708 = shufflevector <8 x double> %707, <8 x double> poison, <8 x i32> zeroinitializer
  %709 = fmul contract <8 x double> %492, %708
  %710 = fadd contract <8 x double> %491, %709
  %711 = insertelement <8 x double> poison, double %704, i64 0
  %712 = shufflevector <8 x double> %711, <8 x double> poison, <8 x i32> zeroinitializer
  %713 = fmul contract <8 x double> %498, %712
  %714 = fadd contract <8 x double> %710, %713
  %715 = insertelement <8 x double> poison, double %706, i64 0
  %716 = shufflevector <8 x double> %715, <8 x double> poison, <8 x i32> zeroinitializer
  %717 = fmul contract <8 x double> %504, %716
  %718 = fadd contract <8 x double> %714, %717
  %719 = fmul contract <8 x double> %512, %708
  %720 = fadd contract <8 x double> %510, %719
  %721 = fmul contract <8 x double> %516, %712
  %722 = fadd contract <8 x double> %720, %721
  %723 = fmul contract <8 x double> %520, %716
  %724 = fadd contract <8 x double> %722, %723
  %725 = fmul contract <8 x double> %526, %708
  %726 = fadd contract <8 x double> %524, %725
  %727 = fmul contract <8 x double> %530, %712
  %728 = fadd contract <8 x double> %726, %727
  %729 = fmul contract <8 x double> %534, %716
  %730 = fadd contract <8 x double> %728, %729
  %731 = fmul contract <8 x double> %567, %718
  %732 = fadd contract <8 x double> %564, %731
  %733 = fmul contract <8 x double> %573, %724
  %734 = fadd contract <8 x double> %733, %732
  %735 = fmul contract <8 x double> %579, %730
  %736 = fadd contract <8 x double> %735, %734
  %737 = fmul contract <8 x double> %589, %718
  %738 = fadd contract <8 x double> %585, %737
  %739 = fmul contract <8 x double> %595, %724
  %740 = fadd contract <8 x double> %739, %738
  %741 = fmul contract <8 x double> %601, %730
  %742 = fadd contract <8 x double> %741, %740
  %743 = fmul contract <8 x double> %611, %718
  %744 = fadd contract <8 x double> %607, %743
  %745 = fmul contract <8 x double> %617, %724
  %746 = fadd contract <8 x double> %745, %744
  %747 = fmul contract <8 x double> %623, %730
  %748 = fadd contract <8 x double> %747, %746
  %749 = fmul contract <8 x double> %736, zeroinitializer
  %750 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %748)
  %751 = select contract i1 %629, <8 x double> %748, <8 x double> %750
  br i1 %634, label %752, label %757

752:
  %753 = fmul contract <8 x double> %736, %736
  %754 = fmul contract <8 x double> %742, %742
  %755 = fadd contract <8 x double> %753, %754
  %756 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %755)
  br label %759

757:
  %758 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %736)
  br label %759

759:
  %760 = phi contract <8 x double> [ %756, %752 ], [ %758, %757 ]
  %761 = fsub contract <8 x double> %760, %647
  %762 = fcmp contract ogt <8 x double> %761, %749
  %763 = select contract <8 x i1> %762, <8 x double> %761, <8 x double> %749
  %764 = fsub contract <8 x double> %751, %654
  %765 = fcmp contract ogt <8 x double> %764, %749
  %766 = select contract <8 x i1> %765, <8 x double> %764, <8 x double> %749
  %767 = fmul contract <8 x double> %763, %763
  %768 = fmul contract <8 x double> %766, %766
  %769 = fadd contract <8 x double> %768, %767
  br i1 %634, label %780, label %770

770:
  %771 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %742)
  %772 = load double, ptr %683, align 8
  %773 = insertelement <8 x double> poison, double %772, i64 0
  %774 = shufflevector <8 x double> %773, <8 x double> poison, <8 x i32> zeroinitializer
  %775 = fsub contract <8 x double> %771, %774
  %776 = fcmp contract ogt <8 x double> %775, %749
  %777 = select contract <8 x i1> %776, <8 x double> %775, <8 x double> %749
  %778 = fmul contract <8 x double> %777, %777
  %779 = fadd contract <8 x double> %769, %778
  br label %780

780:
  %781 = phi <8 x double> [ %779, %770 ], [ %769, %759 ]
  %782 = fmul contract <8 x double> %701, %701
  %783 = fcmp contract olt <8 x double> %781, %782
  %784 = select <8 x i1> %783, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %691
  %785 = add nsw i64 %692, 1
  %786 = icmp eq i64 %785, %680
  br i1 %786, label %684, label %690

787:
  %788 = phi <8 x i64> [ %545, %672 ], [ %545, %544 ], [ %686, %684 ]
  %789 = add nuw nsw i64 %546, 1
  %790 = icmp eq i64 %789, %167
  br i1 %790, label %791, label %544

791:
  %792 = phi <8 x i64> [ %477, %476 ], [ %477, %483 ], [ %788, %787 ]
  %793 = add nuw i64 %478, 1
  %794 = icmp eq i64 %478, %17
  br i1 %794, label %795, label %476

795:
  %796 = phi <8 x i64> [ zeroinitializer, %460 ], [ %792, %791 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %6)
  br i1 %26, label %799, label %797

797:
  %798 = phi <8 x i64> [ %796, %795 ], [ %1290, %1288 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %6)
  br label %1293

799:
  %800 = phi <8 x i64> [ %1290, %1288 ], [ %796, %795 ]
  %801 = phi i64 [ %1289, %1288 ], [ 0, %795 ]
  %802 = phi i64 [ %1291, %1288 ], [ 0, %795 ]
  %803 = getelementptr inbounds %struct.LinkPair, ptr %178, i64 %802
  %804 = load i64, ptr %803, align 8
  %805 = getelementptr inbounds %struct.Sphere.8, ptr %180, i64 %804
  %806 = getelementptr inbounds i8, ptr %803, i64 8
  %807 = load i64, ptr %806, align 8
  %808 = getelementptr inbounds %struct.Sphere.8, ptr %180, i64 %807
  %809 = getelementptr inbounds %struct.Frame.3, ptr %12, i64 %804
  %810 = getelementptr inbounds %struct.Frame.3, ptr %12, i64 %807
  %811 = getelementptr inbounds <8 x double>, ptr %11, i64 %802
  %812 = load <8 x double>, ptr %811, align 64
  %813 = getelementptr inbounds double, ptr %182, i64 %802
  %814 = load double, ptr %813, align 8
  %815 = insertelement <8 x double> poison, double %814, i64 0
  %816 = shufflevector <8 x double> %815, <8 x double> poison, <8 x i32> zeroinitializer
  %817 = fadd contract <8 x double> %812, %816
  %818 = load double, ptr %808, align 8
  %819 = getelementptr inbounds i8, ptr %808, i64 8
  %820 = load double, ptr %819, align 8
  %821 = getelementptr inbounds i8, ptr %808, i64 16
  %822 = load double, ptr %821, align 8
  %823 = getelementptr inbounds i8, ptr %810, i64 576
  %824 = load <8 x double>, ptr %823, align 64
  %825 = load <8 x double>, ptr %810, align 64
  %826 = insertelement <8 x double> poison, double %818, i64 0
  %827 = shufflevector <8 x double> %826, <8 x double> poison, <8 x i32> zeroinitializer
  %828 = fmul contract <8 x double> %827, %825
  %829 = fadd contract <8 x double> %824, %828
  %830 = getelementptr inbounds i8, ptr %810, i64 64
  %831 = load <8 x double>, ptr %830, align 64
  %832 = insertelement <8 x double> poison, double %820, i64 0
  %833 = shufflevector <8 x double> %832, <8 x double> poison, <8 x i32> zeroinitializer
  %834 = fmul contract <8 x double> %833, %831
  %835 = fadd contract <8 x double> %829, %834
  %836 = getelementptr inbounds i8, ptr %810, i64 128
  %837 = load <8 x double>, ptr %836, align 64
  %838 = insertelement <8 x double> poison, double %822, i64 0
  %839 = shufflevector <8 x double> %838, <8 x double> poison, <8 x i32> zeroinitializer
  %840 = fmul contract <8 x double> %839, %837
  %841 = fadd contract <8 x double> %835, %840
  %842 = getelementptr inbounds i8, ptr %810, i64 640
  %843 = load <8 x double>, ptr %842, align 64
  %844 = getelementptr inbounds i8, ptr %810, i64 192
  %845 = load <8 x double>, ptr %844, align 64
  %846 = fmul contract <8 x double> %827, %845
  %847 = fadd contract <8 x double> %843, %846
  %848 = getelementptr inbounds i8, ptr %810, i64 256
  %849 = load <8 x double>, ptr %848, align 64
  %850 = fmul contract <8 x double> %833, %849
  %851 = fadd contract <8 x double> %847, %850
  %852 = getelementptr inbounds i8, ptr %810, i64 320
  %853 = load <8 x double>, ptr %852, align 64
  %854 = fmul contract <8 x double> %839, %853
  %855 = fadd contract <8 x double> %851, %854
  %856 = getelementptr inbounds i8, ptr %810, i64 704
  %857 = load <8 x double>, ptr %856, align 64
  %858 = getelementptr inbounds i8, ptr %810, i64 384
  %859 = load <8 x double>, ptr %858, align 64
  %860 = fmul contract <8 x double> %827, %859
  %861 = fadd contract <8 x double> %857, %860
  %862 = getelementptr inbounds i8, ptr %810, i64 448
  %863 = load <8 x double>, ptr %862, align 64
  %864 = fmul contract <8 x double> %833, %863
  %865 = fadd contract <8 x double> %861, %864
  %866 = getelementptr inbounds i8, ptr %810, i64 512
  %867 = load <8 x double>, ptr %866, align 64
  %868 = fmul contract <8 x double> %839, %867
  %869 = fadd contract <8 x double> %865, %868
  %870 = getelementptr inbounds i8, ptr %805, i64 24
  %871 = load double, ptr %870, align 8
  %872 = getelementptr inbounds i8, ptr %808, i64 24
  %873 = load double, ptr %872, align 8
  %874 = fadd contract double %871, %873
  %875 = insertelement <8 x double> poison, double %874, i64 0
  %876 = shufflevector <8 x double> %875, <8 x double> poison, <8 x i32> zeroinitializer
  %877 = fadd contract <8 x double> %817, %876
  %878 = fcmp contract ogt <8 x double> %877, zeroinitializer
  %879 = select contract <8 x i1> %878, <8 x double> %877, <8 x double> zeroinitializer
  %880 = load double, ptr %805, align 8
  %881 = getelementptr inbounds i8, ptr %805, i64 8
  %882 = load double, ptr %881, align 8
  %883 = getelementptr inbounds i8, ptr %805, i64 16
  %884 = load double, ptr %883, align 8
  %885 = getelementptr inbounds i8, ptr %809, i64 576
  %886 = load <8 x double>, ptr %885, align 64
  %887 = load <8 x double>, ptr %809, align 64
  %888 = insertelement <8 x double> poison, double %880, i64 0
  %889 = shufflevector <8 x double> %888, <8 x double> poison, <8 x i32> zeroinitializer
  %890 = fmul contract <8 x double> %889, %887
  %891 = fadd contract <8 x double> %886, %890
  %892 = getelementptr inbounds i8, ptr %809, i64 64
  %893 = load <8 x double>, ptr %892, align 64
  %894 = insertelement <8 x double> poison, double %882, i64 0
  %895 = shufflevector <8 x double> %894, <8 x double> poison, <8 x i32> zeroinitializer
  %896 = fmul contract <8 x double> %895, %893
  %897 = fadd contract <8 x double> %891, %896
  %898 = getelementptr inbounds i8, ptr %809, i64 128
  %899 = load <8 x double>, ptr %898, align 64
  %900 = insertelement <8 x double> poison, double %884, i64 0
  %901 = shufflevector <8 x double> %900, <8 x double> poison, <8 x i32> zeroinitializer
  %902 = fmul contract <8 x double> %901, %899
  %903 = fadd contract <8 x double> %897, %902
  %904 = getelementptr inbounds i8, ptr %809, i64 640
  %905 = load <8 x double>, ptr %904, align 64
  %906 = getelementptr inbounds i8, ptr %809, i64 192
  %907 = load <8 x double>, ptr %906, align 64
  %908 = fmul contract <8 x double> %889, %907
  %909 = fadd contract <8 x double> %905, %908
  %910 = getelementptr inbounds i8, ptr %809, i64 256
  %911 = load <8 x double>, ptr %910, align 64
  %912 = fmul contract <8 x double> %895, %911
  %913 = fadd contract <8 x double> %909, %912
  %914 = getelementptr inbounds i8, ptr %809, i64 320
  %915 = load <8 x double>, ptr %914, align 64
  %916 = fmul contract <8 x double> %901, %915
  %917 = fadd contract <8 x double> %913, %916
  %918 = getelementptr inbounds i8, ptr %809, i64 704
  %919 = load <8 x double>, ptr %918, align 64
  %920 = getelementptr inbounds i8, ptr %809, i64 384
  %921 = load <8 x double>, ptr %920, align 64
  %922 = fmul contract <8 x double> %889, %921
  %923 = fadd contract <8 x double> %919, %922
  %924 = getelementptr inbounds i8, ptr %809, i64 448
  %925 = load <8 x double>, ptr %924, align 64
  %926 = fmul contract <8 x double> %895, %925
  %927 = fadd contract <8 x double> %923, %926
  %928 = getelementptr inbounds i8, ptr %809, i64 512
  %929 = load <8 x double>, ptr %928, align 64
  %930 = fmul contract <8 x double> %901, %929
  %931 = fadd contract <8 x double> %927, %930
  %932 = fsub contract <8 x double> %903, %841
  %933 = fsub contract <8 x double> %917, %855
  %934 = fsub contract <8 x double> %931, %869
  %935 = fmul contract <8 x double> %932, %932
  %936 = fmul contract <8 x double> %933, %933
  %937 = fadd contract <8 x double> %935, %936
  %938 = fmul contract <8 x double> %934, %934
  %939 = fadd contract <8 x double> %937, %938
  %940 = fmul contract <8 x double> %879, %879
  %941 = fcmp contract olt <8 x double> %939, %940
  %942 = bitcast <8 x i1> %941 to i8
  %943 = icmp eq i8 %942, 0
  br i1 %943, label %1288, label %944

944:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %7)
  store i64 %804, ptr %7, align 16
  store i64 %807, ptr %183, align 8
  br label %951

945:
  %946 = getelementptr inbounds i8, ptr %803, i64 16
  %947 = load i64, ptr %946, align 8
  %948 = getelementptr inbounds i8, ptr %803, i64 24
  %949 = load i64, ptr %948, align 8
  %950 = icmp slt i64 %947, %949
  br i1 %950, label %1034, label %1032

951:
  %952 = phi i64 [ %801, %944 ], [ %1029, %1028 ]
  %953 = phi i64 [ 0, %944 ], [ %1030, %1028 ]
  %954 = getelementptr inbounds i8, ptr %7, i64 %953
  %955 = load i64, ptr %954, align 8
  %956 = shl nuw i64 1, %955
  %957 = and i64 %956, %952
  %958 = icmp eq i64 %957, 0
  br i1 %958, label %959, label %1028

959:
  %960 = or i64 %956, %952
  %961 = getelementptr inbounds i64, ptr %185, i64 %955
  %962 = load i64, ptr %961, align 8
  %963 = getelementptr i8, ptr %961, i64 8
  %964 = load i64, ptr %963, align 8
  %965 = icmp slt i64 %962, %964
  br i1 %965, label %966, label %1028

966:
  %967 = getelementptr inbounds %struct.Frame.3, ptr %12, i64 %955
  %968 = getelementptr inbounds i8, ptr %967, i64 576
  %969 = load <8 x double>, ptr %968, align 64
  %970 = load <8 x double>, ptr %967, align 64
  %971 = getelementptr inbounds i8, ptr %967, i64 64
  %972 = load <8 x double>, ptr %971, align 64
  %973 = getelementptr inbounds i8, ptr %967, i64 128
  %974 = load <8 x double>, ptr %973, align 64
  %975 = getelementptr inbounds i8, ptr %967, i64 640
  %976 = load <8 x double>, ptr %975, align 64
  %977 = getelementptr inbounds i8, ptr %967, i64 192
  %978 = load <8 x double>, ptr %977, align 64
  %979 = getelementptr inbounds i8, ptr %967, i64 256
  %980 = load <8 x double>, ptr %979, align 64
  %981 = getelementptr inbounds i8, ptr %967, i64 320
  %982 = load <8 x double>, ptr %981, align 64
  %983 = getelementptr inbounds i8, ptr %967, i64 704
  %984 = load <8 x double>, ptr %983, align 64
  %985 = getelementptr inbounds i8, ptr %967, i64 384
  %986 = load <8 x double>, ptr %985, align 64
  %987 = getelementptr inbounds i8, ptr %967, i64 448
  %988 = load <8 x double>, ptr %987, align 64
  %989 = getelementptr inbounds i8, ptr %967, i64 512
  %990 = load <8 x double>, ptr %989, align 64
  br label %991

991:
  %992 = phi i64 [ %962, %966 ], [ %1026, %991 ]
  %993 = getelementptr inbounds %struct.Part.10, ptr %187, i64 %992
  %994 = load double, ptr %993, align 8
  %995 = getelementptr inbounds i8, ptr %993, i64 8
  %996 = load double, ptr %995, align 8
  %997 = getelementptr inbounds i8, ptr %993, i64 16
  %998 = load double, ptr %997, align 8
  %999 = insertelement <8 x double> poison, double %994, i64 0
  %1000 = shufflevector <8 x double> %999, <8 x double> poison, <8 x i32> zeroinitializer
  %1001 = fmul contract <8 x double> %1000, %970
  %1002 = fadd contract <8 x double> %969, %1001
  %1003 = insertelement <8 x double> poison, double %996, i64 0
  %1004 = shufflevector <8 x double> %1003, <8 x double> poison, <8 x i32> zeroinitializer
  %1005 = fmul contract <8 x double> %1004, %972
  %1006 = fadd contract <8 x double> %1002, %1005
  %1007 = insertelement <8 x double> poison, double %998, i64 0
  %1008 = shufflevector <8 x double> %1007, <8 x double> poison, <8 x i32> zeroinitializer
  %1009 = fmul contract <8 x double> %1008, %974
  %1010 = fadd contract <8 x double> %1006, %1009
  %1011 = fmul contract <8 x double> %1000, %978
  %1012 = fadd contract <8 x double> %976, %1011
  %1013 = fmul contract <8 x double> %1004, %980
  %1014 = fadd contract <8 x double> %1012, %1013
  %1015 = fmul contract <8 x double> %1008, %982
  %1016 = fadd contract <8 x double> %1014, %1015
  %1017 = fmul contract <8 x double> %1000, %986
  %1018 = fadd contract <8 x double> %984, %1017
  %1019 = fmul contract <8 x double> %1004, %988
  %1020 = fadd contract <8 x double> %1018, %1019
  %1021 = fmul contract <8 x double> %1008, %990
  %1022 = fadd contract <8 x double> %1020, %1021
  %1023 = getelementptr inbounds [192 x %struct.Point.7], ptr %6, i64 0, i64 %992
  store <8 x double> %1010, ptr %1023, align 64
  %1024 = getelementptr inbounds i8, ptr %1023, i64 64
  store <8 x double> %1016, ptr %1024, align 64
  %1025 = getelementptr inbounds i8, ptr %1023, i64 128
  store <8 x double> %1022, ptr %1025, align 64
  %1026 = add nsw i64 %992, 1
  %1027 = icmp eq i64 %1026, %964
  br i1 %1027, label %1028, label %991

1028:
  %1029 = phi i64 [ %952, %951 ], [ %960, %959 ], [ %960, %991 ]
  %1030 = add nuw nsw i64 %953, 8
  %1031 = icmp eq i64 %1030, 16
  br i1 %1031, label %945, label %951

1032:
  %1033 = phi <8 x i64> [ %800, %945 ], [ %1285, %1282 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1288

1034:
  %1035 = phi <8 x i64> [ %1285, %1282 ], [ %800, %945 ]
  %1036 = phi i64 [ %1286, %1282 ], [ %947, %945 ]
  %1037 = phi i1 [ %1283, %1282 ], [ false, %945 ]
  %1038 = phi i64 [ %1284, %1282 ], [ -1, %945 ]
  %1039 = getelementptr inbounds %struct.PartPair, ptr %189, i64 %1036
  %1040 = load i64, ptr %1039, align 8
  %1041 = getelementptr inbounds %struct.Part.10, ptr %187, i64 %1040
  %1042 = getelementptr inbounds i8, ptr %1039, i64 8
  %1043 = load i64, ptr %1042, align 8
  %1044 = getelementptr inbounds %struct.Part.10, ptr %187, i64 %1043
  %1045 = icmp eq i64 %1040, %1038
  br i1 %1045, label %1073, label %1046

1046:
  %1047 = getelementptr inbounds i8, ptr %1041, i64 56
  %1048 = load double, ptr %1047, align 8
  %1049 = fadd contract double %873, %1048
  %1050 = insertelement <8 x double> poison, double %1049, i64 0
  %1051 = shufflevector <8 x double> %1050, <8 x double> poison, <8 x i32> zeroinitializer
  %1052 = fadd contract <8 x double> %817, %1051
  %1053 = fcmp contract ogt <8 x double> %1052, zeroinitializer
  %1054 = select contract <8 x i1> %1053, <8 x double> %1052, <8 x double> zeroinitializer
  %1055 = getelementptr inbounds [192 x %struct.Point.7], ptr %6, i64 0, i64 %1040
  %1056 = load <8 x double>, ptr %1055, align 64
  %1057 = fsub contract <8 x double> %1056, %841
  %1058 = getelementptr inbounds i8, ptr %1055, i64 64
  %1059 = load <8 x double>, ptr %1058, align 64
  %1060 = fsub contract <8 x double> %1059, %855
  %1061 = getelementptr inbounds i8, ptr %1055, i64 128
  %1062 = load <8 x double>, ptr %1061, align 64
  %1063 = fsub contract <8 x double> %1062, %869
  %1064 = fmul contract <8 x double> %1057, %1057
  %1065 = fmul contract <8 x double> %1060, %1060
  %1066 = fadd contract <8 x double> %1064, %1065
  %1067 = fmul contract <8 x double> %1063, %1063
  %1068 = fadd contract <8 x double> %1066, %1067
  %1069 = fmul contract <8 x double> %1054, %1054
  %1070 = fcmp contract olt <8 x double> %1068, %1069
  %1071 = bitcast <8 x i1> %1070 to i8
  %1072 = icmp eq i8 %1071, 0
  br i1 %1072, label %1282, label %1074

1073:
  br i1 %1037, label %1074, label %1282

1074:
  %1075 = phi i64 [ %1040, %1046 ], [ %1038, %1073 ]
  %1076 = getelementptr inbounds i8, ptr %1041, i64 56
  %1077 = load double, ptr %1076, align 8
  %1078 = getelementptr inbounds i8, ptr %1044, i64 56
  %1079 = load double, ptr %1078, align 8
  %1080 = fadd contract double %1077, %1079
  %1081 = insertelement <8 x double> poison, double %1080, i64 0
  %1082 = shufflevector <8 x double> %1081, <8 x double> poison, <8 x i32> zeroinitializer
  %1083 = fadd contract <8 x double> %817, %1082
  %1084 = fcmp contract ogt <8 x double> %1083, zeroinitializer
  %1085 = select contract <8 x i1> %1084, <8 x double> %1083, <8 x double> zeroinitializer
  %1086 = getelementptr inbounds [192 x %struct.Point.7], ptr %6, i64 0, i64 %1040
  %1087 = getelementptr inbounds [192 x %struct.Point.7], ptr %6, i64 0, i64 %1043
  %1088 = load <8 x double>, ptr %1086, align 64
  %1089 = load <8 x double>, ptr %1087, align 64
  %1090 = fsub contract <8 x double> %1088, %1089
  %1091 = getelementptr inbounds i8, ptr %1086, i64 64
  %1092 = load <8 x double>, ptr %1091, align 64
  %1093 = getelementptr inbounds i8, ptr %1087, i64 64
  %1094 = load <8 x double>, ptr %1093, align 64
  %1095 = fsub contract <8 x double> %1092, %1094
  %1096 = getelementptr inbounds i8, ptr %1086, i64 128
  %1097 = load <8 x double>, ptr %1096, align 64
  %1098 = getelementptr inbounds i8, ptr %1087, i64 128
  %1099 = load <8 x double>, ptr %1098, align 64
  %1100 = fsub contract <8 x double> %1097, %1099
  %1101 = fmul contract <8 x double> %1090, %1090
  %1102 = fmul contract <8 x double> %1095, %1095
  %1103 = fadd contract <8 x double> %1101, %1102
  %1104 = fmul contract <8 x double> %1100, %1100
  %1105 = fadd contract <8 x double> %1103, %1104
  %1106 = fmul contract <8 x double> %1085, %1085
  %1107 = fcmp contract olt <8 x double> %1105, %1106
  %1108 = bitcast <8 x i1> %1107 to i8
  %1109 = icmp eq i8 %1108, 0
  br i1 %1109, label %1282, label %1110

1110:
  %1111 = getelementptr inbounds i8, ptr %1041, i64 48
  %1112 = load double, ptr %1111, align 8
  %1113 = getelementptr inbounds i8, ptr %1044, i64 48
  %1114 = load double, ptr %1113, align 8
  %1115 = fadd contract double %1112, %1114
  %1116 = insertelement <8 x double> poison, double %1115, i64 0
  %1117 = shufflevector <8 x double> %1116, <8 x double> poison, <8 x i32> zeroinitializer
  %1118 = fadd contract <8 x double> %817, %1117
  %1119 = fcmp contract ogt <8 x double> %1118, zeroinitializer
  %1120 = select contract <8 x i1> %1119, <8 x double> %1118, <8 x double> zeroinitializer
  %1121 = getelementptr inbounds i8, ptr %1041, i64 24
  %1122 = load double, ptr %1121, align 8
  %1123 = fmul contract double %1122, %1122
  %1124 = getelementptr inbounds i8, ptr %1041, i64 32
  %1125 = load double, ptr %1124, align 8
  %1126 = fmul contract double %1125, %1125
  %1127 = fadd contract double %1123, %1126
  %1128 = getelementptr inbounds i8, ptr %1041, i64 40
  %1129 = load double, ptr %1128, align 8
  %1130 = fmul contract double %1129, %1129
  %1131 = fadd contract double %1127, %1130
  %1132 = getelementptr inbounds i8, ptr %1044, i64 24
  %1133 = load double, ptr %1132, align 8
  %1134 = fmul contract double %1133, %1133
  %1135 = getelementptr inbounds i8, ptr %1044, i64 32
  %1136 = load double, ptr %1135, align 8
  %1137 = fmul contract double %1136, %1136
  %1138 = fadd contract double %1134, %1137
  %1139 = getelementptr inbounds i8, ptr %1044, i64 40
  %1140 = load double, ptr %1139, align 8
  %1141 = fmul contract double %1140, %1140
  %1142 = fadd contract double %1138, %1141
  %1143 = fcmp contract oeq double %1131, 0.000000e+00
  %1144 = fcmp contract oeq double %1142, 0.000000e+00
  %1145 = select i1 %1143, i1 %1144, i1 false
  br i1 %1145, label %1277, label %1146

1146:
  %1147 = fmul contract <8 x double> %1088, zeroinitializer
  %1148 = fadd contract <8 x double> %1147, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %1149 = insertelement <8 x double> poison, double %1122, i64 0
  %1150 = shufflevector <8 x double> %1149, <8 x double> poison, <8 x i32> zeroinitializer
  %1151 = fmul contract <8 x double> %887, %1150
  %1152 = insertelement <8 x double> poison, double %1125, i64 0
  %1153 = shufflevector <8 x double> %1152, <8 x double> poison, <8 x i32> zeroinitializer
  %1154 = fmul contract <8 x double> %893, %1153
  %1155 = fadd contract <8 x double> %1151, %1154
  %1156 = insertelement <8 x double> poison, double %1129, i64 0
  %1157 = shufflevector <8 x double> %1156, <8 x double> poison, <8 x i32> zeroinitializer
  %1158 = fmul contract <8 x double> %899, %1157
  %1159 = fadd contract <8 x double> %1155, %1158
  %1160 = fmul contract <8 x double> %907, %1150
  %1161 = fmul contract <8 x double> %911, %1153
  %1162 = fadd contract <8 x double> %1160, %1161
  %1163 = fmul contract <8 x double> %915, %1157
  %1164 = fadd contract <8 x double> %1162, %1163
  %1165 = fmul contract <8 x double> %921, %1150
  %1166 = fmul contract <8 x double> %925, %1153
  %1167 = fadd contract <8 x double> %1165, %1166
  %1168 = fmul contract <8 x double> %929, %1157
  %1169 = fadd contract <8 x double> %1167, %1168
  %1170 = insertelement <8 x double> poison, double %1133, i64 0
  %1171 = shufflevector <8 x double> %1170, <8 x double> poison, <8 x i32> zeroinitializer
  %1172 = fmul contract <8 x double> %825, %1171
  %1173 = insertelement <8 x double> poison, double %1136, i64 0
  %1174 = shufflevector <8 x double> %1173, <8 x double> poison, <8 x i32> zeroinitializer
  %1175 = fmul contract <8 x double> %831, %1174
  %1176 = fadd contract <8 x double> %1172, %1175
  %1177 = insertelement <8 x double> poison, double %1140, i64 0
  %1178 = shufflevector <8 x double> %1177, <8 x double> poison, <8 x i32> zeroinitializer
  %1179 = fmul contract <8 x double> %837, %1178
  %1180 = fadd contract <8 x double> %1176, %1179
  %1181 = fmul contract <8 x double> %845, %1171
  %1182 = fmul contract <8 x double> %849, %1174
  %1183 = fadd contract <8 x double> %1181, %1182
  %1184 = fmul contract <8 x double> %853, %1178
  %1185 = fadd contract <8 x double> %1183, %1184
  %1186 = fmul contract <8 x double> %859, %1171
  %1187 = fmul contract <8 x double> %863, %1174
  %1188 = fadd contract <8 x double> %1186, %1187
  %1189 = fmul contract <8 x double> %867, %1178
  %1190 = fadd contract <8 x double> %1188, %1189
  %1191 = fcmp contract ogt double %1131, 0.000000e+00
  %1192 = fdiv contract double 1.000000e+00, %1131
  %1193 = select contract i1 %1191, double %1192, double 0.000000e+00
  %1194 = fcmp contract ogt double %1142, 0.000000e+00
  %1195 = fdiv contract double 1.000000e+00, %1142
  %1196 = select contract i1 %1194, double %1195, double 0.000000e+00
  %1197 = fmul contract <8 x double> %1159, %1180
  %1198 = fmul contract <8 x double> %1164, %1185
  %1199 = fadd contract <8 x double> %1197, %1198
  %1200 = fmul contract <8 x double> %1169, %1190
  %1201 = fadd contract <8 x double> %1200, %1199
  %1202 = fmul contract <8 x double> %1090, %1159
  %1203 = fmul contract <8 x double> %1095, %1164
  %1204 = fadd contract <8 x double> %1202, %1203
  %1205 = fmul contract <8 x double> %1100, %1169
  %1206 = fadd contract <8 x double> %1205, %1204
  %1207 = fmul contract <8 x double> %1090, %1180
  %1208 = fmul contract <8 x double> %1095, %1185
  %1209 = fadd contract <8 x double> %1207, %1208
  %1210 = fmul contract <8 x double> %1100, %1190
  %1211 = fadd contract <8 x double> %1210, %1209
  %1212 = fmul contract double %1131, %1142
  %1213 = insertelement <8 x double> poison, double %1212, i64 0
  %1214 = shufflevector <8 x double> %1213, <8 x double> poison, <8 x i32> zeroinitializer
  %1215 = fmul contract <8 x double> %1201, %1201
  %1216 = fsub contract <8 x double> %1214, %1215
  %1217 = fmul contract double %1131, 0x3E7AD7F29ABCAF48
  %1218 = fmul contract double %1217, %1142
  %1219 = insertelement <8 x double> poison, double %1218, i64 0
  %1220 = shufflevector <8 x double> %1219, <8 x double> poison, <8 x i32> zeroinitializer
  %1221 = fcmp contract ogt <8 x double> %1216, %1220
  %1222 = fmul contract <8 x double> %1201, %1211
  %1223 = insertelement <8 x double> poison, double %1142, i64 0
  %1224 = shufflevector <8 x double> %1223, <8 x double> poison, <8 x i32> zeroinitializer
  %1225 = fmul contract <8 x double> %1224, %1206
  %1226 = fsub contract <8 x double> %1222, %1225
  %1227 = select contract <8 x i1> %1221, <8 x double> %1216, <8 x double> %1148
  %1228 = fdiv contract <8 x double> %1226, %1227
  %1229 = fneg contract <8 x double> %1148
  %1230 = fcmp contract ogt <8 x double> %1228, %1229
  %1231 = select contract <8 x i1> %1230, <8 x double> %1228, <8 x double> %1229
  %1232 = fcmp contract olt <8 x double> %1231, %1148
  %1233 = select contract <8 x i1> %1232, <8 x double> %1231, <8 x double> %1148
  %1234 = select contract <8 x i1> %1221, <8 x double> %1233, <8 x double> %1229
  %1235 = fmul contract <8 x double> %1201, %1234
  %1236 = fadd contract <8 x double> %1211, %1235
  %1237 = insertelement <8 x double> poison, double %1196, i64 0
  %1238 = shufflevector <8 x double> %1237, <8 x double> poison, <8 x i32> zeroinitializer
  %1239 = fmul contract <8 x double> %1238, %1236
  %1240 = fcmp contract ogt <8 x double> %1239, %1229
  %1241 = select contract <8 x i1> %1240, <8 x double> %1239, <8 x double> %1229
  %1242 = fcmp contract olt <8 x double> %1241, %1148
  %1243 = select contract <8 x i1> %1242, <8 x double> %1241, <8 x double> %1148
  %1244 = fmul contract <8 x double> %1201, %1243
  %1245 = fsub contract <8 x double> %1244, %1206
  %1246 = insertelement <8 x double> poison, double %1193, i64 0
  %1247 = shufflevector <8 x double> %1246, <8 x double> poison, <8 x i32> zeroinitializer
  %1248 = fmul contract <8 x double> %1247, %1245
  %1249 = fcmp contract ogt <8 x double> %1248, %1229
  %1250 = select contract <8 x i1> %1249, <8 x double> %1248, <8 x double> %1229
  %1251 = fcmp contract olt <8 x double> %1250, %1148
  %1252 = select contract <8 x i1> %1251, <8 x double> %1250, <8 x double> %1148
  %1253 = fmul contract <8 x double> %1201, %1252
  %1254 = fadd contract <8 x double> %1211, %1253
  %1255 = fmul contract <8 x double> %1238, %1254
  %1256 = fcmp contract ogt <8 x double> %1255, %1229
  %1257 = select contract <8 x i1> %1256, <8 x double> %1255, <8 x double> %1229
  %1258 = fcmp contract olt <8 x double> %1257, %1148
  %1259 = select contract <8 x i1> %1258, <8 x double> %1257, <8 x double> %1148
  %1260 = fmul contract <8 x double> %1159, %1252
  %1261 = fadd contract <8 x double> %1090, %1260
  %1262 = fmul contract <8 x double> %1180, %1259
  %1263 = fsub contract <8 x double> %1261, %1262
  %1264 = fmul contract <8 x double> %1164, %1252
  %1265 = fadd contract <8 x double> %1095, %1264
  %1266 = fmul contract <8 x double> %1185, %1259
  %1267 = fsub contract <8 x double> %1265, %1266
  %1268 = fmul contract <8 x double> %1169, %1252
  %1269 = fadd contract <8 x double> %1100, %1268
  %1270 = fmul contract <8 x double> %1190, %1259
  %1271 = fsub contract <8 x double> %1269, %1270
  %1272 = fmul contract <8 x double> %1263, %1263
  %1273 = fmul contract <8 x double> %1267, %1267
  %1274 = fadd contract <8 x double> %1272, %1273
  %1275 = fmul contract <8 x double> %1271, %1271
  %1276 = fadd contract <8 x double> %1275, %1274
  br label %1277

1277:
  %1278 = phi <8 x double> [ %1276, %1146 ], [ %1105, %1110 ]
  %1279 = fmul contract <8 x double> %1120, %1120
  %1280 = fcmp contract olt <8 x double> %1278, %1279
  %1281 = select <8 x i1> %1280, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %1035
  br label %1282

1282:
  %1283 = phi i1 [ true, %1277 ], [ false, %1073 ], [ true, %1074 ], [ false, %1046 ]
  %1284 = phi i64 [ %1075, %1277 ], [ %1038, %1073 ], [ %1075, %1074 ], [ %1040, %1046 ]
  %1285 = phi <8 x i64> [ %1281, %1277 ], [ %1035, %1073 ], [ %1035, %1074 ], [ %1035, %1046 ]
  %1286 = add nsw i64 %1036, 1
  %1287 = icmp eq i64 %1286, %949
  br i1 %1287, label %1032, label %1034

1288:
  %1289 = phi i64 [ %1029, %1032 ], [ %801, %799 ]
  %1290 = phi <8 x i64> [ %1033, %1032 ], [ %800, %799 ]
  %1291 = add nuw nsw i64 %802, 1
  %1292 = icmp eq i64 %1291, %25
  br i1 %1292, label %797, label %799

1293:
  %1294 = phi <8 x i64> [ %798, %797 ], [ %686, %684 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %12)
  call void @llvm.lifetime.end.p0(i64 8704, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 1088, ptr nonnull %10)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %9)
  %1295 = icmp sgt i64 %201, 0
  br i1 %1295, label %1313, label %1343

1296:
  %1297 = phi <8 x double> [ %202, %200 ], [ %1307, %1296 ]
  %1298 = phi <8 x double> [ %203, %200 ], [ %1310, %1296 ]
  %1299 = phi i64 [ 0, %200 ], [ %1311, %1296 ]
  %1300 = icmp sgt i64 %201, %1299
  %1301 = xor i64 %1299, -1
  %1302 = select i1 %1300, i64 %1301, i64 -1
  %1303 = add i64 %1302, %201
  %1304 = getelementptr inbounds [4096 x %struct.Piece], ptr %14, i64 0, i64 %1303
  %1305 = getelementptr inbounds [8 x %struct.Piece], ptr %15, i64 0, i64 %1299
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 16 dereferenceable(16) %1305, ptr noundef nonnull align 16 dereferenceable(16) %1304, i64 16, i1 false)
  %1306 = load double, ptr %1305, align 16
  %1307 = insertelement <8 x double> %1297, double %1306, i64 %1299
  %1308 = getelementptr inbounds i8, ptr %1305, i64 8
  %1309 = load double, ptr %1308, align 8
  %1310 = insertelement <8 x double> %1298, double %1309, i64 %1299
  %1311 = add nuw nsw i64 %1299, 1
  %1312 = icmp eq i64 %1311, 8
  br i1 %1312, label %204, label %1296

1313:
  %1314 = phi i64 [ %1340, %1339 ], [ %206, %1293 ]
  %1315 = phi i64 [ %1341, %1339 ], [ 0, %1293 ]
  %1316 = extractelement <8 x i64> %1294, i64 %1315
  %1317 = icmp eq i64 %1316, 0
  br i1 %1317, label %1339, label %1318

1318:
  %1319 = getelementptr inbounds [8 x %struct.Piece], ptr %15, i64 0, i64 %1315
  %1320 = getelementptr inbounds i8, ptr %1319, i64 8
  %1321 = load double, ptr %1320, align 8
  %1322 = fmul contract double %157, %1321
  %1323 = fmul contract double %1322, 2.000000e+00
  %1324 = fcmp contract olt double %1323, %4
  %1325 = icmp sgt i64 %1314, 4094
  %1326 = select i1 %1324, i1 true, i1 %1325
  br i1 %1326, label %1327, label %1328

1327:
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %15)
  br label %1346

1328:
  %1329 = fmul contract double %1321, 5.000000e-01
  %1330 = load double, ptr %1319, align 16
  %1331 = fsub contract double %1330, %1329
  %1332 = add nsw i64 %1314, 1
  %1333 = getelementptr inbounds [4096 x %struct.Piece], ptr %14, i64 0, i64 %1314
  store double %1331, ptr %1333, align 16
  %1334 = getelementptr inbounds i8, ptr %1333, i64 8
  store double %1329, ptr %1334, align 8
  %1335 = fadd contract double %1329, %1330
  %1336 = add nsw i64 %1314, 2
  %1337 = getelementptr inbounds [4096 x %struct.Piece], ptr %14, i64 0, i64 %1332
  store double %1335, ptr %1337, align 16
  %1338 = getelementptr inbounds i8, ptr %1337, i64 8
  store double %1329, ptr %1338, align 8
  br label %1339

1339:
  %1340 = phi i64 [ %1314, %1313 ], [ %1336, %1328 ]
  %1341 = add nuw nsw i64 %1315, 1
  %1342 = icmp eq i64 %1341, %205
  br i1 %1342, label %1343, label %1313

1343:
  %1344 = phi i64 [ %206, %1293 ], [ %1340, %1339 ]
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %15)
  %1345 = icmp eq i64 %1344, 0
  br i1 %1345, label %1346, label %200

1346:
  %1347 = phi i1 [ false, %1327 ], [ true, %1343 ]
  call void @llvm.lifetime.end.p0(i64 65536, ptr nonnull %14)
  call void @llvm.lifetime.end.p0(i64 2448, ptr nonnull %13)
  ret i1 %1347
}

define void @prove_constraints(ptr noundef %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, ptr nocapture noundef writeonly %5) {
  %7 = icmp sgt i64 %4, 0
  br i1 %7, label %8, label %10

8:
  %9 = getelementptr inbounds i8, ptr %0, i64 16
  br label %11

10:
  ret void

11:
  %12 = phi i64 [ 0, %8 ], [ %23, %11 ]
  %13 = load i64, ptr %0, align 8
  %14 = mul nsw i64 %13, %12
  %15 = getelementptr inbounds double, ptr %1, i64 %14
  %16 = getelementptr inbounds double, ptr %2, i64 %14
  %17 = load i64, ptr %9, align 8
  %18 = mul nsw i64 %17, %12
  %19 = getelementptr inbounds double, ptr %3, i64 %18
  %20 = tail call fastcc noundef zeroext i1 @_ZL17prove_constraintsRK8ManifoldPKdS3_S3_(ptr noundef nonnull align 8 dereferenceable(104) %0, ptr noundef %15, ptr noundef %16, ptr noundef %19)
  %21 = zext i1 %20 to i8
  %22 = getelementptr inbounds i8, ptr %5, i64 %12
  store i8 %21, ptr %22, align 1
  %23 = add nuw nsw i64 %12, 1
  %24 = icmp eq i64 %23, %4
  br i1 %24, label %10, label %11
}

define internal fastcc noundef zeroext i1 @_ZL17prove_constraintsRK8ManifoldPKdS3_S3_(ptr noundef nonnull align 8 dereferenceable(104) %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3) unnamed_addr {
  %5 = alloca [64 x <8 x double>], align 64
  %6 = alloca [64 x <8 x double>], align 64
  %7 = alloca [24 x <8 x double>], align 64
  %8 = alloca [24 x <8 x double>], align 64
  %9 = alloca [4096 x %struct.Piece.11], align 16
  %10 = alloca %struct.Errors, align 64
  %11 = alloca [8 x %struct.Piece.11], align 16
  %12 = load i64, ptr %0, align 8
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %5)
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %6)
  call void @llvm.lifetime.start.p0(i64 1536, ptr nonnull %7)
  call void @llvm.lifetime.start.p0(i64 1536, ptr nonnull %8)
  %13 = icmp sgt i64 %12, 0
  br i1 %13, label %105, label %43

14:
  br i1 %13, label %15, label %43

15:
  %16 = getelementptr inbounds i8, ptr %0, i64 80
  %17 = load ptr, ptr %16, align 8
  br label %22

18:
  br i1 %13, label %19, label %43

19:
  %20 = getelementptr inbounds i8, ptr %0, i64 96
  %21 = load ptr, ptr %20, align 8
  br label %36

22:
  %23 = phi <8 x double> [ zeroinitializer, %15 ], [ %33, %22 ]
  %24 = phi i64 [ 0, %15 ], [ %34, %22 ]
  %25 = getelementptr inbounds <8 x double>, ptr %5, i64 %24
  %26 = load <8 x double>, ptr %25, align 64
  %27 = tail call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %26)
  %28 = getelementptr inbounds double, ptr %17, i64 %24
  %29 = load double, ptr %28, align 8
  %30 = insertelement <8 x double> poison, double %29, i64 0
  %31 = shufflevector <8 x double> %30, <8 x double> poison, <8 x i32> zeroinitializer
  %32 = fmul contract <8 x double> %27, %31
  %33 = fadd contract <8 x double> %23, %32
  %34 = add nuw nsw i64 %24, 1
  %35 = icmp eq i64 %34, %12
  br i1 %35, label %18, label %22

36:
  %37 = phi i64 [ 0, %19 ], [ %54, %53 ]
  %38 = phi <8 x double> [ zeroinitializer, %19 ], [ %68, %53 ]
  %39 = getelementptr inbounds <8 x double>, ptr %5, i64 %37
  %40 = load <8 x double>, ptr %39, align 64
  %41 = mul nuw nsw i64 %37, %12
  %42 = getelementptr double, ptr %21, i64 %41
  br label %56

43:
  %44 = phi <8 x double> [ %33, %18 ], [ zeroinitializer, %14 ], [ zeroinitializer, %4 ], [ %33, %53 ]
  %45 = phi <8 x double> [ zeroinitializer, %18 ], [ zeroinitializer, %14 ], [ zeroinitializer, %4 ], [ %68, %53 ]
  %46 = getelementptr inbounds i8, ptr %0, i64 8
  %47 = load i64, ptr %46, align 8
  %48 = icmp sgt i64 %47, 0
  br i1 %48, label %49, label %100

49:
  %50 = getelementptr inbounds i8, ptr %0, i64 32
  %51 = load ptr, ptr %50, align 8
  %52 = fmul contract <8 x double> %44, %44
  br label %71

53:
  %54 = add nuw nsw i64 %37, 1
  %55 = icmp eq i64 %54, %12
  br i1 %55, label %43, label %36

56:
  %57 = phi i64 [ 0, %36 ], [ %69, %56 ]
  %58 = phi <8 x double> [ %38, %36 ], [ %68, %56 ]
  %59 = getelementptr inbounds <8 x double>, ptr %5, i64 %57
  %60 = load <8 x double>, ptr %59, align 64
  %61 = fmul contract <8 x double> %40, %60
  %62 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %61)
  %63 = getelementptr double, ptr %42, i64 %57
  %64 = load double, ptr %63, align 8
  %65 = insertelement <8 x double> poison, double %64, i64 0
  %66 = shufflevector <8 x double> %65, <8 x double> poison, <8 x i32> zeroinitializer
  %67 = fmul contract <8 x double> %62, %66
  %68 = fadd contract <8 x double> %58, %67
  %69 = add nuw nsw i64 %57, 1
  %70 = icmp eq i64 %69, %12
  br i1 %70, label %53, label %56

71:
  %72 = phi i64 [ 0, %49 ], [ %98, %96 ]
  %73 = phi i64 [ 0, %49 ], [ %97, %96 ]
  %74 = getelementptr inbounds %struct.Constraint, ptr %51, i64 %72
  %75 = load i64, ptr %74, align 8
  %76 = icmp eq i64 %75, 0
  br i1 %76, label %80, label %77

77:
  %78 = add nsw i64 %73, 1
  %79 = getelementptr inbounds <8 x double>, ptr %7, i64 %73
  store <8 x double> %45, ptr %79, align 64
  br label %80

80:
  %81 = phi i64 [ %78, %77 ], [ %73, %71 ]
  %82 = getelementptr inbounds i8, ptr %74, i64 8
  %83 = load i64, ptr %82, align 8
  %84 = icmp eq i64 %83, 0
  br i1 %84, label %85, label %89

85:
  %86 = getelementptr inbounds i8, ptr %74, i64 16
  %87 = load i64, ptr %86, align 8
  %88 = icmp eq i64 %87, 0
  br i1 %88, label %96, label %89

89:
  %90 = phi double [ 1.000000e+00, %85 ], [ 0x3FF6A09E667F3BCD, %80 ]
  %91 = insertelement <8 x double> poison, double %90, i64 0
  %92 = shufflevector <8 x double> %91, <8 x double> poison, <8 x i32> zeroinitializer
  %93 = fmul contract <8 x double> %52, %92
  %94 = add nsw i64 %81, 1
  %95 = getelementptr inbounds <8 x double>, ptr %7, i64 %81
  store <8 x double> %93, ptr %95, align 64
  br label %96

96:
  %97 = phi i64 [ %94, %89 ], [ %81, %85 ]
  %98 = add nuw nsw i64 %72, 1
  %99 = icmp eq i64 %98, %47
  br i1 %99, label %100, label %71

100:
  call void @llvm.lifetime.start.p0(i64 65536, ptr nonnull %9)
  store double 0.000000e+00, ptr %9, align 16
  %101 = getelementptr inbounds i8, ptr %9, i64 8
  store double 1.000000e+00, ptr %101, align 8
  call void @llvm.lifetime.start.p0(i64 103168, ptr nonnull %10)
  %102 = getelementptr inbounds i8, ptr %0, i64 16
  %103 = getelementptr inbounds i8, ptr %10, i64 256
  %104 = getelementptr inbounds i8, ptr %0, i64 48
  br label %115

105:
  %106 = phi i64 [ %113, %105 ], [ 0, %4 ]
  %107 = getelementptr inbounds double, ptr %2, i64 %106
  %108 = load double, ptr %107, align 8
  %109 = insertelement <8 x double> poison, double %108, i64 0
  %110 = fadd contract <8 x double> %109, <double 0.000000e+00, double poison, double poison, double poison, double poison, double poison, double poison, double poison>
  %111 = shufflevector <8 x double> %110, <8 x double> poison, <8 x i32> zeroinitializer
  %112 = getelementptr inbounds [64 x <8 x double>], ptr %5, i64 0, i64 %106
  store <8 x double> %111, ptr %112, align 64
  %113 = add nuw nsw i64 %106, 1
  %114 = icmp eq i64 %113, %12
  br i1 %114, label %14, label %105

115:
  %116 = phi i64 [ 1, %100 ], [ %253, %252 ]
  %117 = phi <8 x double> [ undef, %100 ], [ %133, %252 ]
  %118 = phi <8 x double> [ undef, %100 ], [ %136, %252 ]
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %11)
  br label %122

119:
  %120 = call i64 @llvm.smin.i64(i64 %116, i64 8)
  %121 = sub nsw i64 %116, %120
  br i1 %13, label %142, label %139

122:
  %123 = phi <8 x double> [ %117, %115 ], [ %133, %122 ]
  %124 = phi <8 x double> [ %118, %115 ], [ %136, %122 ]
  %125 = phi i64 [ 0, %115 ], [ %137, %122 ]
  %126 = icmp sgt i64 %116, %125
  %127 = xor i64 %125, -1
  %128 = select i1 %126, i64 %127, i64 -1
  %129 = add i64 %128, %116
  %130 = getelementptr inbounds [4096 x %struct.Piece.11], ptr %9, i64 0, i64 %129
  %131 = getelementptr inbounds [8 x %struct.Piece.11], ptr %11, i64 0, i64 %125
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 16 dereferenceable(16) %131, ptr noundef nonnull align 16 dereferenceable(16) %130, i64 16, i1 false)
  %132 = load double, ptr %131, align 16
  %133 = insertelement <8 x double> %123, double %132, i64 %125
  %134 = getelementptr inbounds i8, ptr %131, i64 8
  %135 = load double, ptr %134, align 8
  %136 = insertelement <8 x double> %124, double %135, i64 %125
  %137 = add nuw nsw i64 %125, 1
  %138 = icmp eq i64 %137, 8
  br i1 %138, label %119, label %122

139:
  call void @_ZN6Errors8evaluateILb0EEEvRK8ManifoldPKDv8_d(ptr noundef nonnull align 64 dereferenceable(103168) %10, ptr noundef nonnull align 8 dereferenceable(104) %0, ptr noundef nonnull %6)
  %140 = load i64, ptr %102, align 8
  %141 = icmp sgt i64 %140, 0
  br i1 %141, label %160, label %157

142:
  %143 = phi i64 [ %155, %142 ], [ 0, %119 ]
  %144 = getelementptr inbounds double, ptr %1, i64 %143
  %145 = load double, ptr %144, align 8
  %146 = insertelement <8 x double> poison, double %145, i64 0
  %147 = shufflevector <8 x double> %146, <8 x double> poison, <8 x i32> zeroinitializer
  %148 = getelementptr inbounds double, ptr %2, i64 %143
  %149 = load double, ptr %148, align 8
  %150 = insertelement <8 x double> poison, double %149, i64 0
  %151 = shufflevector <8 x double> %150, <8 x double> poison, <8 x i32> zeroinitializer
  %152 = fmul contract <8 x double> %133, %151
  %153 = fadd contract <8 x double> %147, %152
  %154 = getelementptr inbounds [64 x <8 x double>], ptr %6, i64 0, i64 %143
  store <8 x double> %153, ptr %154, align 64
  %155 = add nuw nsw i64 %143, 1
  %156 = icmp eq i64 %155, %12
  br i1 %156, label %139, label %142

157:
  br i1 %13, label %158, label %167

158:
  %159 = fadd contract <8 x double> %136, %133
  br label %174

160:
  %161 = phi i64 [ %165, %160 ], [ 0, %139 ]
  %162 = getelementptr inbounds [24 x <8 x double>], ptr %103, i64 0, i64 %161
  %163 = load <8 x double>, ptr %162, align 64
  %164 = getelementptr inbounds [24 x <8 x double>], ptr %8, i64 0, i64 %161
  store <8 x double> %163, ptr %164, align 64
  %165 = add nuw nsw i64 %161, 1
  %166 = icmp eq i64 %165, %140
  br i1 %166, label %157, label %160

167:
  call void @_ZN6Errors8evaluateILb0EEEvRK8ManifoldPKDv8_d(ptr noundef nonnull align 64 dereferenceable(103168) %10, ptr noundef nonnull align 8 dereferenceable(104) %0, ptr noundef nonnull %6)
  %168 = load i64, ptr %102, align 8
  %169 = icmp sgt i64 %168, 0
  br i1 %169, label %170, label %189

170:
  %171 = load ptr, ptr %104, align 8
  %172 = fmul contract <8 x double> %136, <double 1.250000e-01, double 1.250000e-01, double 1.250000e-01, double 1.250000e-01, double 1.250000e-01, double 1.250000e-01, double 1.250000e-01, double 1.250000e-01>
  %173 = fmul contract <8 x double> %136, %172
  br label %197

174:
  %175 = phi i64 [ 0, %158 ], [ %187, %174 ]
  %176 = getelementptr inbounds double, ptr %1, i64 %175
  %177 = load double, ptr %176, align 8
  %178 = insertelement <8 x double> poison, double %177, i64 0
  %179 = shufflevector <8 x double> %178, <8 x double> poison, <8 x i32> zeroinitializer
  %180 = getelementptr inbounds double, ptr %2, i64 %175
  %181 = load double, ptr %180, align 8
  %182 = insertelement <8 x double> poison, double %181, i64 0
  %183 = shufflevector <8 x double> %182, <8 x double> poison, <8 x i32> zeroinitializer
  %184 = fmul contract <8 x double> %159, %183
  %185 = fadd contract <8 x double> %179, %184
  %186 = getelementptr inbounds [64 x <8 x double>], ptr %6, i64 0, i64 %175
  store <8 x double> %185, ptr %186, align 64
  %187 = add nuw nsw i64 %175, 1
  %188 = icmp eq i64 %187, %12
  br i1 %188, label %167, label %174

189:
  %190 = phi <8 x i64> [ zeroinitializer, %167 ], [ %220, %197 ]
  %191 = phi <8 x i64> [ zeroinitializer, %167 ], [ %222, %197 ]
  %192 = icmp ne <8 x i64> %191, zeroinitializer
  %193 = bitcast <8 x i1> %192 to i8
  %194 = icmp eq i8 %193, 0
  br i1 %194, label %195, label %251

195:
  %196 = icmp sgt i64 %116, 0
  br i1 %196, label %225, label %252

197:
  %198 = phi i64 [ 0, %170 ], [ %223, %197 ]
  %199 = phi <8 x i64> [ zeroinitializer, %170 ], [ %222, %197 ]
  %200 = phi <8 x i64> [ zeroinitializer, %170 ], [ %220, %197 ]
  %201 = getelementptr inbounds double, ptr %171, i64 %198
  %202 = load double, ptr %201, align 8
  %203 = fadd contract double %202, 1.000000e-09
  %204 = getelementptr inbounds double, ptr %3, i64 %198
  %205 = load double, ptr %204, align 8
  %206 = fsub contract double %203, %205
  %207 = insertelement <8 x double> poison, double %206, i64 0
  %208 = shufflevector <8 x double> %207, <8 x double> poison, <8 x i32> zeroinitializer
  %209 = getelementptr inbounds [24 x <8 x double>], ptr %8, i64 0, i64 %198
  %210 = load <8 x double>, ptr %209, align 64
  %211 = getelementptr inbounds [24 x <8 x double>], ptr %103, i64 0, i64 %198
  %212 = load <8 x double>, ptr %211, align 64
  %213 = fcmp contract ogt <8 x double> %210, %212
  %214 = select contract <8 x i1> %213, <8 x double> %210, <8 x double> %212
  %215 = fsub contract <8 x double> %208, %214
  %216 = getelementptr inbounds [24 x <8 x double>], ptr %7, i64 0, i64 %198
  %217 = load <8 x double>, ptr %216, align 64
  %218 = fmul contract <8 x double> %173, %217
  %219 = fcmp contract ult <8 x double> %215, %218
  %220 = select <8 x i1> %219, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %200
  %221 = fcmp contract ult <8 x double> %215, zeroinitializer
  %222 = select <8 x i1> %221, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %199
  %223 = add nuw nsw i64 %198, 1
  %224 = icmp eq i64 %223, %168
  br i1 %224, label %189, label %197

225:
  %226 = phi i64 [ %248, %247 ], [ %121, %195 ]
  %227 = phi i64 [ %249, %247 ], [ 0, %195 ]
  %228 = extractelement <8 x i64> %190, i64 %227
  %229 = icmp eq i64 %228, 0
  br i1 %229, label %247, label %230

230:
  %231 = getelementptr inbounds [8 x %struct.Piece.11], ptr %11, i64 0, i64 %227
  %232 = getelementptr inbounds i8, ptr %231, i64 8
  %233 = load double, ptr %232, align 8
  %234 = fmul contract double %233, 5.000000e-01
  %235 = fcmp contract olt double %234, 3.906250e-03
  %236 = icmp sgt i64 %226, 4094
  %237 = select i1 %235, i1 true, i1 %236
  br i1 %237, label %251, label %238

238:
  %239 = load double, ptr %231, align 16
  %240 = add nsw i64 %226, 1
  %241 = getelementptr inbounds [4096 x %struct.Piece.11], ptr %9, i64 0, i64 %226
  store double %239, ptr %241, align 16
  %242 = getelementptr inbounds i8, ptr %241, i64 8
  store double %234, ptr %242, align 8
  %243 = fadd contract double %234, %239
  %244 = add nsw i64 %226, 2
  %245 = getelementptr inbounds [4096 x %struct.Piece.11], ptr %9, i64 0, i64 %240
  store double %243, ptr %245, align 16
  %246 = getelementptr inbounds i8, ptr %245, i64 8
  store double %234, ptr %246, align 8
  br label %247

247:
  %248 = phi i64 [ %226, %225 ], [ %244, %238 ]
  %249 = add nuw nsw i64 %227, 1
  %250 = icmp eq i64 %249, %120
  br i1 %250, label %252, label %225

251:
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %11)
  br label %255

252:
  %253 = phi i64 [ %121, %195 ], [ %248, %247 ]
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %11)
  %254 = icmp eq i64 %253, 0
  br i1 %254, label %255, label %115

255:
  %256 = phi i1 [ false, %251 ], [ true, %252 ]
  call void @llvm.lifetime.end.p0(i64 103168, ptr nonnull %10)
  call void @llvm.lifetime.end.p0(i64 65536, ptr nonnull %9)
  call void @llvm.lifetime.end.p0(i64 1536, ptr nonnull %8)
  call void @llvm.lifetime.end.p0(i64 1536, ptr nonnull %7)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %6)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %5)
  ret i1 %256
}

define void @exclude_boxes(ptr noundef %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, i64 noundef %3, ptr nocapture noundef writeonly %4) {
  %6 = alloca [64 x <8 x double>], align 64
  %7 = alloca [64 x <8 x double>], align 64
  %8 = alloca [24 x <8 x double>], align 64
  %9 = alloca %struct.Errors, align 64
  %10 = load i64, ptr %0, align 8
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %6)
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %7)
  call void @llvm.lifetime.start.p0(i64 1536, ptr nonnull %8)
  %11 = icmp sgt i64 %10, 0
  br i1 %11, label %12, label %41

12:
  %13 = getelementptr inbounds i8, ptr %0, i64 88
  %14 = load ptr, ptr %13, align 8
  %15 = getelementptr inbounds i8, ptr %0, i64 80
  %16 = load ptr, ptr %15, align 8
  br label %110

17:
  %18 = getelementptr inbounds i8, ptr %0, i64 96
  %19 = load ptr, ptr %18, align 8
  br label %34

20:
  %21 = phi <8 x double> [ %31, %20 ], [ zeroinitializer, %110 ]
  %22 = phi i64 [ %32, %20 ], [ 0, %110 ]
  %23 = getelementptr inbounds <8 x double>, ptr %7, i64 %22
  %24 = load <8 x double>, ptr %23, align 64
  %25 = tail call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %24)
  %26 = getelementptr inbounds double, ptr %16, i64 %22
  %27 = load double, ptr %26, align 8
  %28 = insertelement <8 x double> poison, double %27, i64 0
  %29 = shufflevector <8 x double> %28, <8 x double> poison, <8 x i32> zeroinitializer
  %30 = fmul contract <8 x double> %25, %29
  %31 = fadd contract <8 x double> %21, %30
  %32 = add nuw nsw i64 %22, 1
  %33 = icmp eq i64 %32, %10
  br i1 %33, label %17, label %20

34:
  %35 = phi i64 [ 0, %17 ], [ %54, %53 ]
  %36 = phi <8 x double> [ zeroinitializer, %17 ], [ %68, %53 ]
  %37 = getelementptr inbounds <8 x double>, ptr %7, i64 %35
  %38 = load <8 x double>, ptr %37, align 64
  %39 = mul nuw nsw i64 %35, %10
  %40 = getelementptr double, ptr %19, i64 %39
  br label %56

41:
  %42 = phi <8 x double> [ zeroinitializer, %5 ], [ %31, %53 ]
  %43 = phi <8 x double> [ zeroinitializer, %5 ], [ %131, %53 ]
  %44 = phi <8 x double> [ zeroinitializer, %5 ], [ %125, %53 ]
  %45 = phi <8 x double> [ zeroinitializer, %5 ], [ %68, %53 ]
  %46 = getelementptr inbounds i8, ptr %0, i64 8
  %47 = load i64, ptr %46, align 8
  %48 = icmp sgt i64 %47, 0
  br i1 %48, label %49, label %100

49:
  %50 = getelementptr inbounds i8, ptr %0, i64 32
  %51 = load ptr, ptr %50, align 8
  %52 = fmul contract <8 x double> %42, %42
  br label %71

53:
  %54 = add nuw nsw i64 %35, 1
  %55 = icmp eq i64 %54, %10
  br i1 %55, label %41, label %34

56:
  %57 = phi i64 [ 0, %34 ], [ %69, %56 ]
  %58 = phi <8 x double> [ %36, %34 ], [ %68, %56 ]
  %59 = getelementptr inbounds <8 x double>, ptr %7, i64 %57
  %60 = load <8 x double>, ptr %59, align 64
  %61 = fmul contract <8 x double> %38, %60
  %62 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %61)
  %63 = getelementptr double, ptr %40, i64 %57
  %64 = load double, ptr %63, align 8
  %65 = insertelement <8 x double> poison, double %64, i64 0
  %66 = shufflevector <8 x double> %65, <8 x double> poison, <8 x i32> zeroinitializer
  %67 = fmul contract <8 x double> %62, %66
  %68 = fadd contract <8 x double> %58, %67
  %69 = add nuw nsw i64 %57, 1
  %70 = icmp eq i64 %69, %10
  br i1 %70, label %53, label %56

71:
  %72 = phi i64 [ 0, %49 ], [ %98, %96 ]
  %73 = phi i64 [ 0, %49 ], [ %97, %96 ]
  %74 = getelementptr inbounds %struct.Constraint, ptr %51, i64 %72
  %75 = load i64, ptr %74, align 8
  %76 = icmp eq i64 %75, 0
  br i1 %76, label %80, label %77

77:
  %78 = add nsw i64 %73, 1
  %79 = getelementptr inbounds <8 x double>, ptr %8, i64 %73
  store <8 x double> %45, ptr %79, align 64
  br label %80

80:
  %81 = phi i64 [ %78, %77 ], [ %73, %71 ]
  %82 = getelementptr inbounds i8, ptr %74, i64 8
  %83 = load i64, ptr %82, align 8
  %84 = icmp eq i64 %83, 0
  br i1 %84, label %85, label %89

85:
  %86 = getelementptr inbounds i8, ptr %74, i64 16
  %87 = load i64, ptr %86, align 8
  %88 = icmp eq i64 %87, 0
  br i1 %88, label %96, label %89

89:
  %90 = phi double [ 1.000000e+00, %85 ], [ 0x3FF6A09E667F3BCD, %80 ]
  %91 = insertelement <8 x double> poison, double %90, i64 0
  %92 = shufflevector <8 x double> %91, <8 x double> poison, <8 x i32> zeroinitializer
  %93 = fmul contract <8 x double> %52, %92
  %94 = add nsw i64 %81, 1
  %95 = getelementptr inbounds <8 x double>, ptr %8, i64 %81
  store <8 x double> %93, ptr %95, align 64
  br label %96

96:
  %97 = phi i64 [ %94, %89 ], [ %81, %85 ]
  %98 = add nuw nsw i64 %72, 1
  %99 = icmp eq i64 %98, %47
  br i1 %99, label %100, label %71

100:
  call void @llvm.lifetime.start.p0(i64 103168, ptr nonnull %9)
  %101 = icmp sgt i64 %3, 0
  br i1 %101, label %102, label %350

102:
  %103 = getelementptr inbounds i8, ptr %0, i64 32
  %104 = getelementptr inbounds i8, ptr %9, i64 8
  %105 = getelementptr inbounds i8, ptr %9, i64 1792
  %106 = getelementptr inbounds i8, ptr %9, i64 3328
  %107 = getelementptr inbounds i8, ptr %9, i64 101632
  %108 = getelementptr inbounds i8, ptr %9, i64 256
  %109 = getelementptr inbounds i8, ptr %0, i64 48
  br label %134

110:
  %111 = phi <8 x double> [ zeroinitializer, %12 ], [ %125, %110 ]
  %112 = phi i64 [ 0, %12 ], [ %132, %110 ]
  %113 = phi <8 x double> [ zeroinitializer, %12 ], [ %131, %110 ]
  %114 = getelementptr inbounds double, ptr %2, i64 %112
  %115 = load double, ptr %114, align 8
  %116 = insertelement <8 x double> poison, double %115, i64 0
  %117 = fadd contract <8 x double> %116, <double 0.000000e+00, double poison, double poison, double poison, double poison, double poison, double poison, double poison>
  %118 = shufflevector <8 x double> %117, <8 x double> poison, <8 x i32> zeroinitializer
  %119 = getelementptr inbounds [64 x <8 x double>], ptr %7, i64 0, i64 %112
  store <8 x double> %118, ptr %119, align 64
  %120 = getelementptr inbounds double, ptr %14, i64 %112
  %121 = load double, ptr %120, align 8
  %122 = insertelement <8 x double> poison, double %121, i64 0
  %123 = fmul contract <8 x double> %117, %122
  %124 = shufflevector <8 x double> %123, <8 x double> poison, <8 x i32> zeroinitializer
  %125 = fadd contract <8 x double> %111, %124
  %126 = getelementptr inbounds double, ptr %16, i64 %112
  %127 = load double, ptr %126, align 8
  %128 = insertelement <8 x double> poison, double %127, i64 0
  %129 = fmul contract <8 x double> %117, %128
  %130 = shufflevector <8 x double> %129, <8 x double> poison, <8 x i32> zeroinitializer
  %131 = fadd contract <8 x double> %113, %130
  %132 = add nuw nsw i64 %112, 1
  %133 = icmp eq i64 %132, %10
  br i1 %133, label %20, label %110

134:
  %135 = phi i64 [ 0, %102 ], [ %341, %340 ]
  br i1 %11, label %136, label %141

136:
  %137 = phi i64 [ %148, %147 ], [ 0, %134 ]
  %138 = getelementptr double, ptr %1, i64 %137
  %139 = getelementptr inbounds [64 x <8 x double>], ptr %6, i64 0, i64 %137
  %140 = load <8 x double>, ptr %139, align 64
  br label %150

141:
  call void @_ZN6Errors8evaluateILb1EEEvRK8ManifoldPKDv8_d(ptr noundef nonnull align 64 dereferenceable(103168) %9, ptr noundef nonnull align 8 dereferenceable(104) %0, ptr noundef nonnull %6)
  %142 = load i64, ptr %46, align 8
  %143 = icmp sgt i64 %142, 0
  br i1 %143, label %144, label %162

144:
  %145 = load ptr, ptr %103, align 8
  %146 = load ptr, ptr %109, align 8
  br label %164

147:
  store <8 x double> %159, ptr %139, align 64
  %148 = add nuw nsw i64 %137, 1
  %149 = icmp eq i64 %148, %10
  br i1 %149, label %141, label %136

150:
  %151 = phi i64 [ 0, %136 ], [ %160, %150 ]
  %152 = phi <8 x double> [ %140, %136 ], [ %159, %150 ]
  %153 = or disjoint i64 %151, %135
  %154 = icmp slt i64 %153, %3
  %155 = select i1 %154, i64 %153, i64 %135
  %156 = mul nuw nsw i64 %155, %10
  %157 = getelementptr double, ptr %138, i64 %156
  %158 = load double, ptr %157, align 8
  %159 = insertelement <8 x double> %152, double %158, i64 %151
  %160 = add nuw nsw i64 %151, 1
  %161 = icmp eq i64 %160, 8
  br i1 %161, label %147, label %150

162:
  %163 = phi <8 x i64> [ zeroinitializer, %141 ], [ %333, %331 ]
  br label %336

164:
  %165 = phi i64 [ 0, %144 ], [ %334, %331 ]
  %166 = phi <8 x i64> [ zeroinitializer, %144 ], [ %333, %331 ]
  %167 = phi i64 [ 0, %144 ], [ %332, %331 ]
  %168 = getelementptr inbounds %struct.Constraint, ptr %145, i64 %165
  %169 = load i64, ptr %168, align 8
  %170 = icmp eq i64 %169, 0
  br i1 %170, label %244, label %171

171:
  %172 = icmp eq i64 %167, 0
  br i1 %172, label %177, label %173

173:
  %174 = add nsw i64 %167, -1
  %175 = getelementptr inbounds [24 x i64], ptr %104, i64 0, i64 %174
  %176 = load i64, ptr %175, align 8
  br label %177

177:
  %178 = phi i64 [ %176, %173 ], [ 0, %171 ]
  %179 = getelementptr inbounds [24 x i64], ptr %104, i64 0, i64 %167
  %180 = load i64, ptr %179, align 8
  %181 = icmp slt i64 %178, %180
  br i1 %181, label %184, label %182

182:
  %183 = phi <8 x double> [ zeroinitializer, %177 ], [ %190, %184 ]
  br i1 %11, label %193, label %216

184:
  %185 = phi i64 [ %191, %184 ], [ %178, %177 ]
  %186 = phi <8 x double> [ %190, %184 ], [ zeroinitializer, %177 ]
  %187 = getelementptr inbounds [24 x <8 x double>], ptr %105, i64 0, i64 %185
  %188 = load <8 x double>, ptr %187, align 64
  %189 = fmul contract <8 x double> %188, %188
  %190 = fadd contract <8 x double> %186, %189
  %191 = add nsw i64 %185, 1
  %192 = icmp eq i64 %191, %180
  br i1 %192, label %182, label %184

193:
  %194 = phi i64 [ %203, %196 ], [ 0, %182 ]
  %195 = phi <8 x double> [ %202, %196 ], [ zeroinitializer, %182 ]
  br i1 %181, label %205, label %196

196:
  %197 = phi <8 x double> [ zeroinitializer, %193 ], [ %213, %205 ]
  %198 = call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %197)
  %199 = getelementptr inbounds [64 x <8 x double>], ptr %7, i64 0, i64 %194
  %200 = load <8 x double>, ptr %199, align 64
  %201 = fmul contract <8 x double> %198, %200
  %202 = fadd contract <8 x double> %195, %201
  %203 = add nuw nsw i64 %194, 1
  %204 = icmp eq i64 %203, %10
  br i1 %204, label %216, label %193

205:
  %206 = phi i64 [ %214, %205 ], [ %178, %193 ]
  %207 = phi <8 x double> [ %213, %205 ], [ zeroinitializer, %193 ]
  %208 = getelementptr inbounds [24 x <8 x double>], ptr %105, i64 0, i64 %206
  %209 = load <8 x double>, ptr %208, align 64
  %210 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %106, i64 0, i64 %206, i64 %194
  %211 = load <8 x double>, ptr %210, align 64
  %212 = fmul contract <8 x double> %209, %211
  %213 = fadd contract <8 x double> %207, %212
  %214 = add nsw i64 %206, 1
  %215 = icmp eq i64 %214, %180
  br i1 %215, label %196, label %205

216:
  %217 = phi <8 x double> [ zeroinitializer, %182 ], [ %202, %196 ]
  %218 = getelementptr inbounds [24 x <8 x double>], ptr %107, i64 0, i64 %167
  %219 = load <8 x double>, ptr %218, align 64
  %220 = fmul contract <8 x double> %217, %219
  %221 = call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %183)
  %222 = fcmp contract ogt <8 x double> %221, <double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11>
  %223 = select contract <8 x i1> %222, <8 x double> %221, <8 x double> <double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11>
  %224 = fdiv contract <8 x double> %220, %223
  %225 = getelementptr inbounds [24 x <8 x double>], ptr %8, i64 0, i64 %167
  %226 = load <8 x double>, ptr %225, align 64
  %227 = fmul contract <8 x double> %226, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %228 = fadd contract <8 x double> %224, %227
  %229 = fcmp contract olt <8 x double> %219, <double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A>
  %230 = fcmp contract olt <8 x double> %228, %44
  %231 = select <8 x i1> %229, <8 x i1> %230, <8 x i1> zeroinitializer
  %232 = select contract <8 x i1> %231, <8 x double> %228, <8 x double> %44
  %233 = getelementptr inbounds [24 x <8 x double>], ptr %108, i64 0, i64 %167
  %234 = load <8 x double>, ptr %233, align 64
  %235 = fsub contract <8 x double> %234, %232
  %236 = getelementptr inbounds double, ptr %146, i64 %167
  %237 = load double, ptr %236, align 8
  %238 = fadd contract double %237, 2.000000e-09
  %239 = insertelement <8 x double> poison, double %238, i64 0
  %240 = shufflevector <8 x double> %239, <8 x double> poison, <8 x i32> zeroinitializer
  %241 = fcmp contract ogt <8 x double> %235, %240
  %242 = select <8 x i1> %241, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %166
  %243 = add nsw i64 %167, 1
  br label %244

244:
  %245 = phi i64 [ %167, %164 ], [ %243, %216 ]
  %246 = phi <8 x i64> [ %166, %164 ], [ %242, %216 ]
  %247 = getelementptr inbounds i8, ptr %168, i64 8
  %248 = load i64, ptr %247, align 8
  %249 = icmp eq i64 %248, 0
  br i1 %249, label %250, label %254

250:
  %251 = getelementptr inbounds i8, ptr %168, i64 16
  %252 = load i64, ptr %251, align 8
  %253 = icmp eq i64 %252, 0
  br i1 %253, label %331, label %254

254:
  %255 = phi double [ 1.000000e+00, %250 ], [ 0x3FF6A09E667F3BCD, %244 ]
  %256 = insertelement <8 x double> poison, double %255, i64 0
  %257 = shufflevector <8 x double> %256, <8 x double> poison, <8 x i32> zeroinitializer
  %258 = fmul contract <8 x double> %43, %257
  %259 = icmp eq i64 %245, 0
  br i1 %259, label %264, label %260

260:
  %261 = add nsw i64 %245, -1
  %262 = getelementptr inbounds [24 x i64], ptr %104, i64 0, i64 %261
  %263 = load i64, ptr %262, align 8
  br label %264

264:
  %265 = phi i64 [ %263, %260 ], [ 0, %254 ]
  %266 = getelementptr inbounds [24 x i64], ptr %104, i64 0, i64 %245
  %267 = load i64, ptr %266, align 8
  %268 = icmp slt i64 %265, %267
  br i1 %268, label %271, label %269

269:
  %270 = phi <8 x double> [ zeroinitializer, %264 ], [ %277, %271 ]
  br i1 %11, label %280, label %303

271:
  %272 = phi i64 [ %278, %271 ], [ %265, %264 ]
  %273 = phi <8 x double> [ %277, %271 ], [ zeroinitializer, %264 ]
  %274 = getelementptr inbounds [24 x <8 x double>], ptr %105, i64 0, i64 %272
  %275 = load <8 x double>, ptr %274, align 64
  %276 = fmul contract <8 x double> %275, %275
  %277 = fadd contract <8 x double> %273, %276
  %278 = add nsw i64 %272, 1
  %279 = icmp eq i64 %278, %267
  br i1 %279, label %269, label %271

280:
  %281 = phi i64 [ %290, %283 ], [ 0, %269 ]
  %282 = phi <8 x double> [ %289, %283 ], [ zeroinitializer, %269 ]
  br i1 %268, label %292, label %283

283:
  %284 = phi <8 x double> [ zeroinitializer, %280 ], [ %300, %292 ]
  %285 = call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %284)
  %286 = getelementptr inbounds [64 x <8 x double>], ptr %7, i64 0, i64 %281
  %287 = load <8 x double>, ptr %286, align 64
  %288 = fmul contract <8 x double> %285, %287
  %289 = fadd contract <8 x double> %282, %288
  %290 = add nuw nsw i64 %281, 1
  %291 = icmp eq i64 %290, %10
  br i1 %291, label %303, label %280

292:
  %293 = phi i64 [ %301, %292 ], [ %265, %280 ]
  %294 = phi <8 x double> [ %300, %292 ], [ zeroinitializer, %280 ]
  %295 = getelementptr inbounds [24 x <8 x double>], ptr %105, i64 0, i64 %293
  %296 = load <8 x double>, ptr %295, align 64
  %297 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %106, i64 0, i64 %293, i64 %281
  %298 = load <8 x double>, ptr %297, align 64
  %299 = fmul contract <8 x double> %296, %298
  %300 = fadd contract <8 x double> %294, %299
  %301 = add nsw i64 %293, 1
  %302 = icmp eq i64 %301, %267
  br i1 %302, label %283, label %292

303:
  %304 = phi <8 x double> [ zeroinitializer, %269 ], [ %289, %283 ]
  %305 = getelementptr inbounds [24 x <8 x double>], ptr %107, i64 0, i64 %245
  %306 = load <8 x double>, ptr %305, align 64
  %307 = fmul contract <8 x double> %304, %306
  %308 = call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %270)
  %309 = fcmp contract ogt <8 x double> %308, <double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11>
  %310 = select contract <8 x i1> %309, <8 x double> %308, <8 x double> <double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11>
  %311 = fdiv contract <8 x double> %307, %310
  %312 = getelementptr inbounds [24 x <8 x double>], ptr %8, i64 0, i64 %245
  %313 = load <8 x double>, ptr %312, align 64
  %314 = fmul contract <8 x double> %313, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %315 = fadd contract <8 x double> %311, %314
  %316 = fcmp contract olt <8 x double> %306, <double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A>
  %317 = fcmp contract olt <8 x double> %315, %258
  %318 = select <8 x i1> %316, <8 x i1> %317, <8 x i1> zeroinitializer
  %319 = select contract <8 x i1> %318, <8 x double> %315, <8 x double> %258
  %320 = getelementptr inbounds [24 x <8 x double>], ptr %108, i64 0, i64 %245
  %321 = load <8 x double>, ptr %320, align 64
  %322 = fsub contract <8 x double> %321, %319
  %323 = getelementptr inbounds double, ptr %146, i64 %245
  %324 = load double, ptr %323, align 8
  %325 = fadd contract double %324, 2.000000e-09
  %326 = insertelement <8 x double> poison, double %325, i64 0
  %327 = shufflevector <8 x double> %326, <8 x double> poison, <8 x i32> zeroinitializer
  %328 = fcmp contract ogt <8 x double> %322, %327
  %329 = select <8 x i1> %328, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %246
  %330 = add nsw i64 %245, 1
  br label %331

331:
  %332 = phi i64 [ %245, %250 ], [ %330, %303 ]
  %333 = phi <8 x i64> [ %246, %250 ], [ %329, %303 ]
  %334 = add nuw nsw i64 %165, 1
  %335 = icmp eq i64 %334, %142
  br i1 %335, label %162, label %164

336:
  %337 = phi i64 [ 0, %162 ], [ %348, %343 ]
  %338 = or disjoint i64 %337, %135
  %339 = icmp slt i64 %338, %3
  br i1 %339, label %343, label %340

340:
  %341 = add nuw nsw i64 %135, 8
  %342 = icmp slt i64 %341, %3
  br i1 %342, label %134, label %350

343:
  %344 = extractelement <8 x i64> %163, i64 %337
  %345 = icmp ne i64 %344, 0
  %346 = zext i1 %345 to i8
  %347 = getelementptr inbounds i8, ptr %4, i64 %338
  store i8 %346, ptr %347, align 1
  %348 = add nuw nsw i64 %337, 1
  %349 = icmp eq i64 %348, 8
  br i1 %349, label %340, label %336

350:
  call void @llvm.lifetime.end.p0(i64 103168, ptr nonnull %9)
  call void @llvm.lifetime.end.p0(i64 1536, ptr nonnull %8)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %7)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %6)
  ret void
}

define void @evaluate_errors(ptr noundef %0, ptr nocapture noundef readonly %1, i64 noundef %2, ptr nocapture noundef writeonly %3, ptr nocapture noundef writeonly %4, ptr nocapture noundef writeonly %5) {
  %7 = alloca [64 x <8 x double>], align 64
  %8 = alloca %struct.Errors, align 64
  %9 = load i64, ptr %0, align 8
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %7)
  call void @llvm.lifetime.start.p0(i64 103168, ptr nonnull %8)
  %10 = icmp sgt i64 %2, 0
  br i1 %10, label %11, label %97

11:
  %12 = icmp sgt i64 %9, 0
  %13 = getelementptr inbounds i8, ptr %0, i64 16
  %14 = getelementptr inbounds i8, ptr %8, i64 256
  %15 = getelementptr inbounds i8, ptr %8, i64 1792
  %16 = getelementptr inbounds i8, ptr %8, i64 3328
  br label %17

17:
  %18 = phi i64 [ 0, %11 ], [ %51, %50 ]
  %19 = phi ptr [ %3, %11 ], [ %54, %50 ]
  %20 = phi ptr [ %4, %11 ], [ %69, %50 ]
  %21 = phi ptr [ %5, %11 ], [ %68, %50 ]
  br i1 %12, label %22, label %27

22:
  %23 = phi i64 [ %29, %28 ], [ 0, %17 ]
  %24 = getelementptr double, ptr %1, i64 %23
  %25 = getelementptr inbounds [64 x <8 x double>], ptr %7, i64 0, i64 %23
  %26 = load <8 x double>, ptr %25, align 64
  br label %31

27:
  call void @_ZN6Errors8evaluateILb1EEEvRK8ManifoldPKDv8_d(ptr noundef nonnull align 64 dereferenceable(103168) %8, ptr noundef nonnull align 8 dereferenceable(104) %0, ptr noundef nonnull %7)
  br label %43

28:
  store <8 x double> %40, ptr %25, align 64
  %29 = add nuw nsw i64 %23, 1
  %30 = icmp eq i64 %29, %9
  br i1 %30, label %27, label %22

31:
  %32 = phi i64 [ 0, %22 ], [ %41, %31 ]
  %33 = phi <8 x double> [ %26, %22 ], [ %40, %31 ]
  %34 = or disjoint i64 %32, %18
  %35 = icmp slt i64 %34, %2
  %36 = select i1 %35, i64 %34, i64 %18
  %37 = mul nuw nsw i64 %36, %9
  %38 = getelementptr double, ptr %24, i64 %37
  %39 = load double, ptr %38, align 8
  %40 = insertelement <8 x double> %33, double %39, i64 %32
  %41 = add nuw nsw i64 %32, 1
  %42 = icmp eq i64 %41, 8
  br i1 %42, label %28, label %31

43:
  %44 = phi i64 [ %70, %67 ], [ 0, %27 ]
  %45 = phi ptr [ %54, %67 ], [ %19, %27 ]
  %46 = phi ptr [ %69, %67 ], [ %20, %27 ]
  %47 = phi ptr [ %68, %67 ], [ %21, %27 ]
  %48 = load i64, ptr %13, align 8
  %49 = icmp sgt i64 %48, 0
  br i1 %49, label %57, label %53

50:
  %51 = add nuw nsw i64 %18, 8
  %52 = icmp slt i64 %51, %2
  br i1 %52, label %17, label %97

53:
  %54 = phi ptr [ %45, %43 ], [ %63, %57 ]
  %55 = load i64, ptr %8, align 64
  %56 = icmp sgt i64 %55, 0
  br i1 %56, label %75, label %67

57:
  %58 = phi i64 [ %64, %57 ], [ 0, %43 ]
  %59 = phi ptr [ %63, %57 ], [ %45, %43 ]
  %60 = getelementptr inbounds [24 x <8 x double>], ptr %14, i64 0, i64 %58
  %61 = load <8 x double>, ptr %60, align 64
  %62 = extractelement <8 x double> %61, i64 %44
  %63 = getelementptr inbounds i8, ptr %59, i64 8
  store double %62, ptr %59, align 8
  %64 = add nuw nsw i64 %58, 1
  %65 = load i64, ptr %13, align 8
  %66 = icmp slt i64 %64, %65
  br i1 %66, label %57, label %53

67:
  %68 = phi ptr [ %47, %53 ], [ %84, %83 ]
  %69 = phi ptr [ %46, %53 ], [ %82, %83 ]
  %70 = add nuw nsw i64 %44, 1
  %71 = icmp ult i64 %44, 7
  %72 = or disjoint i64 %70, %18
  %73 = icmp slt i64 %72, %2
  %74 = select i1 %71, i1 %73, i1 false
  br i1 %74, label %43, label %50

75:
  %76 = phi i64 [ %85, %83 ], [ 0, %53 ]
  %77 = phi ptr [ %82, %83 ], [ %46, %53 ]
  %78 = phi ptr [ %84, %83 ], [ %47, %53 ]
  %79 = getelementptr inbounds [24 x <8 x double>], ptr %15, i64 0, i64 %76
  %80 = load <8 x double>, ptr %79, align 64
  %81 = extractelement <8 x double> %80, i64 %44
  %82 = getelementptr inbounds i8, ptr %77, i64 8
  store double %81, ptr %77, align 8
  br i1 %12, label %88, label %83

83:
  %84 = phi ptr [ %78, %75 ], [ %94, %88 ]
  %85 = add nuw nsw i64 %76, 1
  %86 = load i64, ptr %8, align 64
  %87 = icmp slt i64 %85, %86
  br i1 %87, label %75, label %67

88:
  %89 = phi i64 [ %95, %88 ], [ 0, %75 ]
  %90 = phi ptr [ %94, %88 ], [ %78, %75 ]
  %91 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %16, i64 0, i64 %76, i64 %89
  %92 = load <8 x double>, ptr %91, align 64
  %93 = extractelement <8 x double> %92, i64 %44
  %94 = getelementptr inbounds i8, ptr %90, i64 8
  store double %93, ptr %90, align 8
  %95 = add nuw nsw i64 %89, 1
  %96 = icmp eq i64 %95, %9
  br i1 %96, label %83, label %88

97:
  call void @llvm.lifetime.end.p0(i64 103168, ptr nonnull %8)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %7)
  ret void
}

define void @extend_paths(ptr noundef %0, ptr noundef readonly %1, ptr nocapture noundef readonly %2) {
  %4 = alloca [64 x <8 x double>], align 64
  %5 = alloca [64 x <8 x double>], align 64
  %6 = alloca [24 x [24 x <8 x double>]], align 64
  %7 = alloca [24 x <8 x double>], align 64
  %8 = alloca [64 x <8 x double>], align 64
  %9 = alloca [64 x <8 x double>], align 64
  %10 = alloca [64 x <8 x double>], align 64
  %11 = alloca [64 x <8 x double>], align 64
  %12 = alloca [64 x <8 x double>], align 64
  %13 = alloca [24 x <8 x double>], align 64
  %14 = alloca [8 x i64], align 16
  %15 = alloca %struct.Errors, align 64
  %16 = alloca [64 x double], align 16
  %17 = alloca [64 x double], align 16
  %18 = load i64, ptr %0, align 8
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %8)
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %10)
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %12)
  call void @llvm.lifetime.start.p0(i64 1536, ptr nonnull %13)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %14)
  call void @llvm.lifetime.start.p0(i64 103168, ptr nonnull %15)
  br label %21

19:
  %20 = icmp sgt i64 %18, 0
  br i1 %20, label %50, label %26

21:
  %22 = phi i64 [ 0, %3 ], [ %24, %21 ]
  %23 = getelementptr inbounds [8 x i64], ptr %14, i64 0, i64 %22
  store i64 -1, ptr %23, align 8
  %24 = add nuw nsw i64 %22, 1
  %25 = icmp eq i64 %24, 8
  br i1 %25, label %19, label %21

26:
  %27 = getelementptr inbounds i8, ptr %2, i64 32
  %28 = getelementptr inbounds i8, ptr %2, i64 8
  %29 = getelementptr inbounds i8, ptr %2, i64 72
  %30 = getelementptr inbounds i8, ptr %2, i64 80
  %31 = getelementptr inbounds i8, ptr %0, i64 64
  %32 = getelementptr inbounds i8, ptr %0, i64 72
  %33 = getelementptr inbounds i8, ptr %0, i64 16
  %34 = getelementptr inbounds i8, ptr %15, i64 256
  %35 = getelementptr inbounds i8, ptr %0, i64 48
  %36 = getelementptr inbounds i8, ptr %2, i64 16
  %37 = getelementptr inbounds i8, ptr %2, i64 24
  %38 = getelementptr inbounds i8, ptr %0, i64 80
  %39 = getelementptr inbounds i8, ptr %0, i64 96
  %40 = getelementptr inbounds i8, ptr %0, i64 8
  %41 = getelementptr inbounds i8, ptr %0, i64 32
  %42 = getelementptr inbounds i8, ptr %0, i64 56
  %43 = getelementptr inbounds i8, ptr %15, i64 1792
  %44 = getelementptr inbounds i8, ptr %15, i64 3328
  %45 = getelementptr inbounds i8, ptr %2, i64 56
  %46 = icmp eq ptr %1, null
  %47 = getelementptr inbounds i8, ptr %2, i64 48
  %48 = getelementptr inbounds i8, ptr %2, i64 64
  %49 = getelementptr inbounds i8, ptr %2, i64 40
  br label %56

50:
  %51 = phi i64 [ %54, %50 ], [ 0, %19 ]
  %52 = getelementptr inbounds [64 x <8 x double>], ptr %9, i64 0, i64 %51
  store <8 x double> zeroinitializer, ptr %52, align 64
  %53 = getelementptr inbounds [64 x <8 x double>], ptr %8, i64 0, i64 %51
  store <8 x double> zeroinitializer, ptr %53, align 64
  %54 = add nuw nsw i64 %51, 1
  %55 = icmp eq i64 %54, %18
  br i1 %55, label %26, label %50

56:
  %57 = phi <8 x i64> [ %160, %766 ], [ zeroinitializer, %26 ]
  %58 = phi i64 [ %763, %766 ], [ 0, %26 ]
  %59 = phi i64 [ %159, %766 ], [ 0, %26 ]
  %60 = icmp slt i64 %58, 8
  %61 = load i64, ptr %27, align 8
  %62 = icmp slt i64 %59, %61
  %63 = and i1 %60, %62
  br i1 %62, label %68, label %66

64:
  %65 = icmp eq i64 %107, 0
  br i1 %65, label %767, label %113

66:
  %67 = icmp eq i64 %58, 0
  br i1 %67, label %767, label %157

68:
  %69 = phi i64 [ %106, %105 ], [ %61, %56 ]
  %70 = phi i64 [ %108, %105 ], [ %59, %56 ]
  %71 = phi i64 [ %107, %105 ], [ %58, %56 ]
  %72 = phi i64 [ %109, %105 ], [ 0, %56 ]
  %73 = getelementptr inbounds [8 x i64], ptr %14, i64 0, i64 %72
  %74 = load i64, ptr %73, align 8
  %75 = icmp sgt i64 %74, -1
  br i1 %75, label %105, label %76

76:
  %77 = add nsw i64 %70, 1
  store i64 %70, ptr %73, align 8
  %78 = add nsw i64 %71, 1
  br i1 %20, label %79, label %85

79:
  %80 = load ptr, ptr %2, align 8
  %81 = mul nsw i64 %70, %18
  %82 = getelementptr double, ptr %80, i64 %81
  %83 = load ptr, ptr %28, align 8
  %84 = getelementptr double, ptr %83, i64 %81
  br label %91

85:
  %86 = load ptr, ptr %29, align 8
  %87 = getelementptr inbounds i64, ptr %86, i64 %70
  store i64 0, ptr %87, align 8
  %88 = load ptr, ptr %30, align 8
  %89 = getelementptr inbounds i8, ptr %88, i64 %70
  store i8 0, ptr %89, align 1
  %90 = load i64, ptr %27, align 8
  br label %105

91:
  %92 = phi i64 [ 0, %79 ], [ %103, %91 ]
  %93 = getelementptr double, ptr %82, i64 %92
  %94 = load double, ptr %93, align 8
  %95 = getelementptr inbounds [64 x <8 x double>], ptr %8, i64 0, i64 %92
  %96 = load <8 x double>, ptr %95, align 64
  %97 = insertelement <8 x double> %96, double %94, i64 %72
  store <8 x double> %97, ptr %95, align 64
  %98 = getelementptr double, ptr %84, i64 %92
  %99 = load double, ptr %98, align 8
  %100 = getelementptr inbounds [64 x <8 x double>], ptr %9, i64 0, i64 %92
  %101 = load <8 x double>, ptr %100, align 64
  %102 = insertelement <8 x double> %101, double %99, i64 %72
  store <8 x double> %102, ptr %100, align 64
  %103 = add nuw nsw i64 %92, 1
  %104 = icmp eq i64 %103, %18
  br i1 %104, label %85, label %91

105:
  %106 = phi i64 [ %69, %68 ], [ %90, %85 ]
  %107 = phi i64 [ %71, %68 ], [ %78, %85 ]
  %108 = phi i64 [ %70, %68 ], [ %77, %85 ]
  %109 = add nuw nsw i64 %72, 1
  %110 = icmp ult i64 %72, 7
  %111 = icmp slt i64 %108, %106
  %112 = select i1 %110, i1 %111, i1 false
  br i1 %112, label %68, label %64

113:
  br i1 %63, label %114, label %157

114:
  call void @_ZN6Errors8evaluateILb0EEEvRK8ManifoldPKDv8_d(ptr noundef nonnull align 64 dereferenceable(103168) %15, ptr noundef nonnull align 8 dereferenceable(104) %0, ptr noundef nonnull %9)
  br i1 %20, label %115, label %118

115:
  %116 = load ptr, ptr %31, align 8
  %117 = load ptr, ptr %32, align 8
  br label %124

118:
  %119 = phi <8 x i64> [ <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, %114 ], [ %140, %124 ]
  %120 = load i64, ptr %33, align 8
  %121 = icmp sgt i64 %120, 0
  br i1 %121, label %122, label %157

122:
  %123 = load ptr, ptr %35, align 8
  br label %143

124:
  %125 = phi <8 x i64> [ <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, %115 ], [ %140, %124 ]
  %126 = phi i64 [ 0, %115 ], [ %141, %124 ]
  %127 = getelementptr inbounds [64 x <8 x double>], ptr %9, i64 0, i64 %126
  %128 = load <8 x double>, ptr %127, align 64
  %129 = getelementptr inbounds double, ptr %116, i64 %126
  %130 = load double, ptr %129, align 8
  %131 = insertelement <8 x double> poison, double %130, i64 0
  %132 = shufflevector <8 x double> %131, <8 x double> poison, <8 x i32> zeroinitializer
  %133 = fcmp contract oge <8 x double> %128, %132
  %134 = getelementptr inbounds double, ptr %117, i64 %126
  %135 = load double, ptr %134, align 8
  %136 = insertelement <8 x double> poison, double %135, i64 0
  %137 = shufflevector <8 x double> %136, <8 x double> poison, <8 x i32> zeroinitializer
  %138 = fcmp contract ole <8 x double> %128, %137
  %139 = and <8 x i1> %138, %133
  %140 = select <8 x i1> %139, <8 x i64> %125, <8 x i64> zeroinitializer
  %141 = add nuw nsw i64 %126, 1
  %142 = icmp eq i64 %141, %18
  br i1 %142, label %118, label %124

143:
  %144 = phi <8 x i64> [ %119, %122 ], [ %154, %143 ]
  %145 = phi i64 [ 0, %122 ], [ %155, %143 ]
  %146 = getelementptr inbounds [24 x <8 x double>], ptr %34, i64 0, i64 %145
  %147 = load <8 x double>, ptr %146, align 64
  %148 = getelementptr inbounds double, ptr %123, i64 %145
  %149 = load double, ptr %148, align 8
  %150 = fadd contract double %149, 1.000000e-09
  %151 = insertelement <8 x double> poison, double %150, i64 0
  %152 = shufflevector <8 x double> %151, <8 x double> poison, <8 x i32> zeroinitializer
  %153 = fcmp contract ole <8 x double> %147, %152
  %154 = select <8 x i1> %153, <8 x i64> %144, <8 x i64> zeroinitializer
  %155 = add nuw nsw i64 %145, 1
  %156 = icmp eq i64 %155, %120
  br i1 %156, label %157, label %143

157:
  %158 = phi i64 [ %107, %113 ], [ %107, %118 ], [ %58, %66 ], [ %107, %143 ]
  %159 = phi i64 [ %108, %113 ], [ %108, %118 ], [ %59, %66 ], [ %108, %143 ]
  %160 = phi <8 x i64> [ %57, %113 ], [ %119, %118 ], [ %57, %66 ], [ %154, %143 ]
  br i1 %20, label %275, label %163

161:
  %162 = load ptr, ptr %36, align 8
  br label %174

163:
  %164 = phi <8 x double> [ zeroinitializer, %157 ], [ %189, %174 ]
  %165 = phi <8 x double> [ zeroinitializer, %157 ], [ %187, %174 ]
  %166 = load i64, ptr %37, align 8
  %167 = icmp eq i64 %166, 0
  %168 = call contract <8 x double> @llvm.sqrt.v8f64(<8 x double> %165)
  %169 = select contract i1 %167, <8 x double> %168, <8 x double> %164
  %170 = load i64, ptr %0, align 8
  %171 = icmp sgt i64 %170, 0
  br i1 %171, label %172, label %208

172:
  %173 = load ptr, ptr %38, align 8
  br label %194

174:
  %175 = phi <8 x double> [ zeroinitializer, %161 ], [ %187, %174 ]
  %176 = phi i64 [ 0, %161 ], [ %190, %174 ]
  %177 = phi <8 x double> [ zeroinitializer, %161 ], [ %189, %174 ]
  %178 = getelementptr inbounds <8 x double>, ptr %10, i64 %176
  %179 = load <8 x double>, ptr %178, align 64
  %180 = getelementptr inbounds double, ptr %162, i64 %176
  %181 = load double, ptr %180, align 8
  %182 = insertelement <8 x double> poison, double %181, i64 0
  %183 = shufflevector <8 x double> %182, <8 x double> poison, <8 x i32> zeroinitializer
  %184 = fmul contract <8 x double> %179, %183
  %185 = call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %184)
  %186 = fmul contract <8 x double> %184, %184
  %187 = fadd contract <8 x double> %175, %186
  %188 = fcmp contract ogt <8 x double> %177, %185
  %189 = select contract <8 x i1> %188, <8 x double> %177, <8 x double> %185
  %190 = add nuw nsw i64 %176, 1
  %191 = icmp eq i64 %190, %18
  br i1 %191, label %163, label %174

192:
  %193 = load ptr, ptr %39, align 8
  br label %216

194:
  %195 = phi <8 x double> [ zeroinitializer, %172 ], [ %205, %194 ]
  %196 = phi i64 [ 0, %172 ], [ %206, %194 ]
  %197 = getelementptr inbounds <8 x double>, ptr %10, i64 %196
  %198 = load <8 x double>, ptr %197, align 64
  %199 = call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %198)
  %200 = getelementptr inbounds double, ptr %173, i64 %196
  %201 = load double, ptr %200, align 8
  %202 = insertelement <8 x double> poison, double %201, i64 0
  %203 = shufflevector <8 x double> %202, <8 x double> poison, <8 x i32> zeroinitializer
  %204 = fmul contract <8 x double> %199, %203
  %205 = fadd contract <8 x double> %195, %204
  %206 = add nuw nsw i64 %196, 1
  %207 = icmp eq i64 %206, %170
  br i1 %207, label %192, label %194

208:
  %209 = phi <8 x double> [ zeroinitializer, %163 ], [ %205, %223 ]
  %210 = phi <8 x double> [ zeroinitializer, %163 ], [ %238, %223 ]
  %211 = load i64, ptr %40, align 8
  %212 = icmp sgt i64 %211, 0
  br i1 %212, label %213, label %241

213:
  %214 = load ptr, ptr %41, align 8
  %215 = fmul contract <8 x double> %209, %209
  br label %246

216:
  %217 = phi i64 [ 0, %192 ], [ %224, %223 ]
  %218 = phi <8 x double> [ zeroinitializer, %192 ], [ %238, %223 ]
  %219 = getelementptr inbounds <8 x double>, ptr %10, i64 %217
  %220 = load <8 x double>, ptr %219, align 64
  %221 = mul nuw nsw i64 %217, %170
  %222 = getelementptr double, ptr %193, i64 %221
  br label %226

223:
  %224 = add nuw nsw i64 %217, 1
  %225 = icmp eq i64 %224, %170
  br i1 %225, label %208, label %216

226:
  %227 = phi i64 [ 0, %216 ], [ %239, %226 ]
  %228 = phi <8 x double> [ %218, %216 ], [ %238, %226 ]
  %229 = getelementptr inbounds <8 x double>, ptr %10, i64 %227
  %230 = load <8 x double>, ptr %229, align 64
  %231 = fmul contract <8 x double> %220, %230
  %232 = call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %231)
  %233 = getelementptr double, ptr %222, i64 %227
  %234 = load double, ptr %233, align 8
  %235 = insertelement <8 x double> poison, double %234, i64 0
  %236 = shufflevector <8 x double> %235, <8 x double> poison, <8 x i32> zeroinitializer
  %237 = fmul contract <8 x double> %232, %236
  %238 = fadd contract <8 x double> %228, %237
  %239 = add nuw nsw i64 %227, 1
  %240 = icmp eq i64 %239, %170
  br i1 %240, label %223, label %226

241:
  %242 = load i64, ptr %33, align 8
  %243 = icmp sgt i64 %242, 0
  br i1 %243, label %244, label %285

244:
  %245 = load ptr, ptr %42, align 8
  br label %290

246:
  %247 = phi i64 [ 0, %213 ], [ %273, %271 ]
  %248 = phi i64 [ 0, %213 ], [ %272, %271 ]
  %249 = getelementptr inbounds %struct.Constraint, ptr %214, i64 %247
  %250 = load i64, ptr %249, align 8
  %251 = icmp eq i64 %250, 0
  br i1 %251, label %255, label %252

252:
  %253 = add nsw i64 %248, 1
  %254 = getelementptr inbounds <8 x double>, ptr %13, i64 %248
  store <8 x double> %210, ptr %254, align 64
  br label %255

255:
  %256 = phi i64 [ %253, %252 ], [ %248, %246 ]
  %257 = getelementptr inbounds i8, ptr %249, i64 8
  %258 = load i64, ptr %257, align 8
  %259 = icmp eq i64 %258, 0
  br i1 %259, label %260, label %264

260:
  %261 = getelementptr inbounds i8, ptr %249, i64 16
  %262 = load i64, ptr %261, align 8
  %263 = icmp eq i64 %262, 0
  br i1 %263, label %271, label %264

264:
  %265 = phi double [ 1.000000e+00, %260 ], [ 0x3FF6A09E667F3BCD, %255 ]
  %266 = insertelement <8 x double> poison, double %265, i64 0
  %267 = shufflevector <8 x double> %266, <8 x double> poison, <8 x i32> zeroinitializer
  %268 = fmul contract <8 x double> %215, %267
  %269 = add nsw i64 %256, 1
  %270 = getelementptr inbounds <8 x double>, ptr %13, i64 %256
  store <8 x double> %268, ptr %270, align 64
  br label %271

271:
  %272 = phi i64 [ %269, %264 ], [ %256, %260 ]
  %273 = add nuw nsw i64 %247, 1
  %274 = icmp eq i64 %273, %211
  br i1 %274, label %241, label %246

275:
  %276 = phi i64 [ %283, %275 ], [ 0, %157 ]
  %277 = getelementptr inbounds [64 x <8 x double>], ptr %9, i64 0, i64 %276
  %278 = load <8 x double>, ptr %277, align 64
  %279 = getelementptr inbounds [64 x <8 x double>], ptr %8, i64 0, i64 %276
  %280 = load <8 x double>, ptr %279, align 64
  %281 = fsub contract <8 x double> %278, %280
  %282 = getelementptr inbounds [64 x <8 x double>], ptr %10, i64 0, i64 %276
  store <8 x double> %281, ptr %282, align 64
  %283 = add nuw nsw i64 %276, 1
  %284 = icmp eq i64 %283, %18
  br i1 %284, label %161, label %275

285:
  %286 = phi <8 x double> [ <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %241 ], [ %305, %290 ]
  br i1 %20, label %314, label %287

287:
  %288 = fcmp contract oeq <8 x double> %286, <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>
  %289 = select <8 x i1> %288, <8 x i64> %160, <8 x i64> zeroinitializer
  br label %322

290:
  %291 = phi i64 [ 0, %244 ], [ %306, %290 ]
  %292 = phi <8 x double> [ <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %244 ], [ %305, %290 ]
  %293 = getelementptr inbounds double, ptr %245, i64 %291
  %294 = load double, ptr %293, align 8
  %295 = fmul contract double %294, 4.000000e+00
  %296 = insertelement <8 x double> poison, double %295, i64 0
  %297 = shufflevector <8 x double> %296, <8 x double> poison, <8 x i32> zeroinitializer
  %298 = getelementptr inbounds [24 x <8 x double>], ptr %13, i64 0, i64 %291
  %299 = load <8 x double>, ptr %298, align 64
  %300 = fcmp contract ogt <8 x double> %299, <double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300>
  %301 = select contract <8 x i1> %300, <8 x double> %299, <8 x double> <double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300, double 1.000000e-300>
  %302 = fdiv contract <8 x double> %297, %301
  %303 = call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %302)
  %304 = fcmp contract olt <8 x double> %292, %303
  %305 = select contract <8 x i1> %304, <8 x double> %292, <8 x double> %303
  %306 = add nuw nsw i64 %291, 1
  %307 = icmp eq i64 %306, %242
  br i1 %307, label %285, label %290

308:
  %309 = fcmp contract oeq <8 x double> %286, <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>
  %310 = select <8 x i1> %309, <8 x i64> %160, <8 x i64> zeroinitializer
  %311 = load ptr, ptr %31, align 8
  %312 = load ptr, ptr %32, align 8
  %313 = icmp eq <8 x i64> %310, zeroinitializer
  br label %607

314:
  %315 = phi i64 [ %320, %314 ], [ 0, %285 ]
  %316 = getelementptr inbounds [64 x <8 x double>], ptr %10, i64 0, i64 %315
  %317 = load <8 x double>, ptr %316, align 64
  %318 = fmul contract <8 x double> %286, %317
  %319 = getelementptr inbounds [64 x <8 x double>], ptr %11, i64 0, i64 %315
  store <8 x double> %318, ptr %319, align 64
  %320 = add nuw nsw i64 %315, 1
  %321 = icmp eq i64 %320, %18
  br i1 %321, label %308, label %314

322:
  %323 = phi <8 x i64> [ %289, %287 ], [ %310, %607 ]
  %324 = xor <8 x i64> %323, <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>
  br label %325

325:
  %326 = phi i64 [ 0, %322 ], [ %585, %584 ]
  call void @_ZN6Errors8evaluateILb1EEEvRK8ManifoldPKDv8_d(ptr noundef nonnull align 64 dereferenceable(103168) %15, ptr noundef nonnull align 8 dereferenceable(104) %0, ptr noundef nonnull %12)
  %327 = load i64, ptr %15, align 64
  %328 = icmp sgt i64 %327, 0
  br i1 %328, label %344, label %329

329:
  %330 = phi <8 x double> [ zeroinitializer, %325 ], [ %351, %344 ]
  %331 = fcmp contract ogt <8 x double> %330, <double 1.000000e-08, double 1.000000e-08, double 1.000000e-08, double 1.000000e-08, double 1.000000e-08, double 1.000000e-08, double 1.000000e-08, double 1.000000e-08>
  %332 = select <8 x i1> %331, <8 x i64> %324, <8 x i64> zeroinitializer
  %333 = icmp eq i64 %326, 12
  %334 = icmp ne <8 x i64> %332, zeroinitializer
  %335 = bitcast <8 x i1> %334 to i8
  %336 = icmp eq i8 %335, 0
  %337 = select i1 %333, i1 true, i1 %336
  br i1 %337, label %338, label %354

338:
  br i1 %20, label %342, label %339

339:
  %340 = load i64, ptr %37, align 8
  %341 = icmp eq i64 %340, 0
  br label %636

342:
  %343 = load ptr, ptr %36, align 8
  br label %589

344:
  %345 = phi i64 [ %352, %344 ], [ 0, %325 ]
  %346 = phi <8 x double> [ %351, %344 ], [ zeroinitializer, %325 ]
  %347 = getelementptr inbounds [24 x <8 x double>], ptr %43, i64 0, i64 %345
  %348 = load <8 x double>, ptr %347, align 64
  %349 = call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %348)
  %350 = fcmp contract ogt <8 x double> %346, %349
  %351 = select contract <8 x i1> %350, <8 x double> %346, <8 x double> %349
  %352 = add nuw nsw i64 %345, 1
  %353 = icmp eq i64 %352, %327
  br i1 %353, label %329, label %344

354:
  %355 = load i64, ptr %0, align 8
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %4)
  call void @llvm.lifetime.start.p0(i64 4096, ptr nonnull %5)
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %6)
  call void @llvm.lifetime.start.p0(i64 1536, ptr nonnull %7)
  %356 = icmp sgt i64 %355, 0
  %357 = load ptr, ptr %31, align 8
  %358 = load ptr, ptr %32, align 8
  br i1 %356, label %359, label %372

359:
  %360 = phi i64 [ %370, %359 ], [ 0, %354 ]
  %361 = getelementptr inbounds double, ptr %357, i64 %360
  %362 = load double, ptr %361, align 8
  %363 = getelementptr inbounds double, ptr %358, i64 %360
  %364 = load double, ptr %363, align 8
  %365 = fcmp contract olt double %362, %364
  %366 = uitofp i1 %365 to double
  %367 = insertelement <8 x double> poison, double %366, i64 0
  %368 = shufflevector <8 x double> %367, <8 x double> poison, <8 x i32> zeroinitializer
  %369 = getelementptr inbounds [64 x <8 x double>], ptr %4, i64 0, i64 %360
  store <8 x double> %368, ptr %369, align 64
  %370 = add nuw nsw i64 %360, 1
  %371 = icmp eq i64 %370, %355
  br i1 %371, label %372, label %359

372:
  br label %373

373:
  %374 = phi i1 [ false, %492 ], [ true, %372 ]
  br i1 %328, label %378, label %468

375:
  %376 = fmul contract <8 x double> %394, <double 1.000000e-10, double 1.000000e-10, double 1.000000e-10, double 1.000000e-10, double 1.000000e-10, double 1.000000e-10, double 1.000000e-10, double 1.000000e-10>
  %377 = fadd contract <8 x double> %376, <double 0x3D06849B86A12B9B, double 0x3D06849B86A12B9B, double 0x3D06849B86A12B9B, double 0x3D06849B86A12B9B, double 0x3D06849B86A12B9B, double 0x3D06849B86A12B9B, double 0x3D06849B86A12B9B, double 0x3D06849B86A12B9B>
  br label %411

378:
  %379 = phi i64 [ %387, %385 ], [ 1, %373 ]
  %380 = phi i64 [ %386, %385 ], [ 0, %373 ]
  %381 = phi <8 x double> [ %394, %385 ], [ zeroinitializer, %373 ]
  br label %382

382:
  %383 = phi i64 [ 0, %378 ], [ %395, %389 ]
  %384 = phi <8 x double> [ %381, %378 ], [ %394, %389 ]
  br i1 %356, label %397, label %389

385:
  %386 = add nuw nsw i64 %380, 1
  %387 = add nuw i64 %379, 1
  %388 = icmp eq i64 %386, %327
  br i1 %388, label %375, label %378

389:
  %390 = phi <8 x double> [ zeroinitializer, %382 ], [ %408, %397 ]
  %391 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %380, i64 %383
  store <8 x double> %390, ptr %391, align 64
  %392 = icmp eq i64 %380, %383
  %393 = fadd contract <8 x double> %384, %390
  %394 = select i1 %392, <8 x double> %393, <8 x double> %384
  %395 = add nuw nsw i64 %383, 1
  %396 = icmp eq i64 %395, %379
  br i1 %396, label %385, label %382

397:
  %398 = phi i64 [ %409, %397 ], [ 0, %382 ]
  %399 = phi <8 x double> [ %408, %397 ], [ zeroinitializer, %382 ]
  %400 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %44, i64 0, i64 %380, i64 %398
  %401 = load <8 x double>, ptr %400, align 64
  %402 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %44, i64 0, i64 %383, i64 %398
  %403 = load <8 x double>, ptr %402, align 64
  %404 = fmul contract <8 x double> %401, %403
  %405 = getelementptr inbounds [64 x <8 x double>], ptr %4, i64 0, i64 %398
  %406 = load <8 x double>, ptr %405, align 64
  %407 = fmul contract <8 x double> %404, %406
  %408 = fadd contract <8 x double> %399, %407
  %409 = add nuw nsw i64 %398, 1
  %410 = icmp eq i64 %409, %355
  br i1 %410, label %389, label %397

411:
  %412 = phi i64 [ 0, %375 ], [ %439, %431 ]
  %413 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %412, i64 %412
  %414 = load <8 x double>, ptr %413, align 64
  %415 = fadd contract <8 x double> %377, %414
  store <8 x double> %415, ptr %413, align 64
  %416 = getelementptr inbounds [24 x <8 x double>], ptr %43, i64 0, i64 %412
  %417 = load <8 x double>, ptr %416, align 64
  %418 = getelementptr inbounds [24 x <8 x double>], ptr %7, i64 0, i64 %412
  store <8 x double> %417, ptr %418, align 64
  %419 = icmp eq i64 %412, 0
  br i1 %419, label %431, label %420

420:
  %421 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %412, i64 0
  br label %422

422:
  %423 = phi <8 x double> [ %417, %420 ], [ %454, %441 ]
  %424 = phi i64 [ 0, %420 ], [ %455, %441 ]
  %425 = icmp eq i64 %424, 0
  br i1 %425, label %426, label %428

426:
  %427 = load <8 x double>, ptr %421, align 64
  br label %441

428:
  %429 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %412, i64 %424
  %430 = load <8 x double>, ptr %429, align 64
  br label %457

431:
  %432 = phi <8 x double> [ %417, %411 ], [ %454, %441 ]
  %433 = phi <8 x double> [ %415, %411 ], [ %449, %441 ]
  %434 = fcmp contract ogt <8 x double> %433, <double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30>
  %435 = select contract <8 x i1> %434, <8 x double> %433, <8 x double> <double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30, double 1.000000e-30>
  %436 = call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %435)
  %437 = fdiv contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %436
  store <8 x double> %437, ptr %413, align 64
  %438 = fmul contract <8 x double> %432, %437
  store <8 x double> %438, ptr %418, align 64
  %439 = add nuw nsw i64 %412, 1
  %440 = icmp eq i64 %439, %327
  br i1 %440, label %469, label %411

441:
  %442 = phi <8 x double> [ %427, %426 ], [ %465, %457 ]
  %443 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %424, i64 %424
  %444 = load <8 x double>, ptr %443, align 64
  %445 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %412, i64 %424
  %446 = fmul contract <8 x double> %442, %444
  store <8 x double> %446, ptr %445, align 64
  %447 = fmul contract <8 x double> %446, %446
  %448 = load <8 x double>, ptr %413, align 64
  %449 = fsub contract <8 x double> %448, %447
  store <8 x double> %449, ptr %413, align 64
  %450 = load <8 x double>, ptr %445, align 64
  %451 = getelementptr inbounds [24 x <8 x double>], ptr %7, i64 0, i64 %424
  %452 = load <8 x double>, ptr %451, align 64
  %453 = fmul contract <8 x double> %450, %452
  %454 = fsub contract <8 x double> %423, %453
  store <8 x double> %454, ptr %418, align 64
  %455 = add nuw nsw i64 %424, 1
  %456 = icmp eq i64 %455, %412
  br i1 %456, label %431, label %422

457:
  %458 = phi <8 x double> [ %430, %428 ], [ %465, %457 ]
  %459 = phi i64 [ 0, %428 ], [ %466, %457 ]
  %460 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %412, i64 %459
  %461 = load <8 x double>, ptr %460, align 64
  %462 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %424, i64 %459
  %463 = load <8 x double>, ptr %462, align 64
  %464 = fmul contract <8 x double> %461, %463
  %465 = fsub contract <8 x double> %458, %464
  store <8 x double> %465, ptr %429, align 64
  %466 = add nuw nsw i64 %459, 1
  %467 = icmp eq i64 %466, %424
  br i1 %467, label %441, label %457

468:
  br i1 %356, label %497, label %584

469:
  %470 = phi i64 [ %471, %475 ], [ %327, %431 ]
  %471 = add nsw i64 %470, -1
  %472 = icmp slt i64 %470, %327
  %473 = getelementptr inbounds [24 x <8 x double>], ptr %7, i64 0, i64 %471
  %474 = load <8 x double>, ptr %473, align 64
  br i1 %472, label %481, label %475

475:
  %476 = phi <8 x double> [ %474, %469 ], [ %489, %481 ]
  %477 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %471, i64 %471
  %478 = load <8 x double>, ptr %477, align 64
  %479 = fmul contract <8 x double> %476, %478
  store <8 x double> %479, ptr %473, align 64
  %480 = icmp sgt i64 %470, 1
  br i1 %480, label %469, label %468

481:
  %482 = phi <8 x double> [ %489, %481 ], [ %474, %469 ]
  %483 = phi i64 [ %490, %481 ], [ %470, %469 ]
  %484 = getelementptr inbounds [24 x [24 x <8 x double>]], ptr %6, i64 0, i64 %483, i64 %471
  %485 = load <8 x double>, ptr %484, align 64
  %486 = getelementptr inbounds [24 x <8 x double>], ptr %7, i64 0, i64 %483
  %487 = load <8 x double>, ptr %486, align 64
  %488 = fmul contract <8 x double> %485, %487
  %489 = fsub contract <8 x double> %482, %488
  store <8 x double> %489, ptr %473, align 64
  %490 = add nuw nsw i64 %483, 1
  %491 = icmp eq i64 %490, %327
  br i1 %491, label %475, label %481

492:
  %493 = icmp ne <8 x i64> %537, zeroinitializer
  %494 = bitcast <8 x i1> %493 to i8
  %495 = icmp ne i8 %494, 0
  %496 = and i1 %374, %495
  br i1 %496, label %373, label %545

497:
  %498 = phi i64 [ %538, %536 ], [ 0, %468 ]
  %499 = phi <8 x i64> [ %537, %536 ], [ zeroinitializer, %468 ]
  %500 = getelementptr inbounds [64 x <8 x double>], ptr %5, i64 0, i64 %498
  br i1 %328, label %523, label %501

501:
  %502 = phi <8 x double> [ zeroinitializer, %497 ], [ %531, %523 ]
  %503 = getelementptr inbounds [64 x <8 x double>], ptr %4, i64 0, i64 %498
  %504 = load <8 x double>, ptr %503, align 64
  %505 = fmul contract <8 x double> %502, %504
  store <8 x double> %505, ptr %500, align 64
  %506 = getelementptr inbounds <8 x double>, ptr %12, i64 %498
  %507 = load <8 x double>, ptr %506, align 64
  %508 = getelementptr inbounds double, ptr %357, i64 %498
  %509 = load double, ptr %508, align 8
  %510 = insertelement <8 x double> poison, double %509, i64 0
  %511 = shufflevector <8 x double> %510, <8 x double> poison, <8 x i32> zeroinitializer
  %512 = fcmp contract ole <8 x double> %507, %511
  %513 = fcmp contract olt <8 x double> %505, zeroinitializer
  %514 = and <8 x i1> %512, %513
  %515 = getelementptr inbounds double, ptr %358, i64 %498
  %516 = load double, ptr %515, align 8
  %517 = insertelement <8 x double> poison, double %516, i64 0
  %518 = shufflevector <8 x double> %517, <8 x double> poison, <8 x i32> zeroinitializer
  %519 = fcmp contract oge <8 x double> %507, %518
  %520 = fcmp contract ogt <8 x double> %505, zeroinitializer
  %521 = and <8 x i1> %519, %520
  %522 = or <8 x i1> %521, %514
  br i1 %374, label %534, label %536

523:
  %524 = phi <8 x double> [ %531, %523 ], [ zeroinitializer, %497 ]
  %525 = phi i64 [ %532, %523 ], [ 0, %497 ]
  %526 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %44, i64 0, i64 %525, i64 %498
  %527 = load <8 x double>, ptr %526, align 64
  %528 = getelementptr inbounds [24 x <8 x double>], ptr %7, i64 0, i64 %525
  %529 = load <8 x double>, ptr %528, align 64
  %530 = fmul contract <8 x double> %527, %529
  %531 = fadd contract <8 x double> %524, %530
  %532 = add nuw nsw i64 %525, 1
  %533 = icmp eq i64 %532, %327
  br i1 %533, label %501, label %523

534:
  %535 = select contract <8 x i1> %522, <8 x double> zeroinitializer, <8 x double> %504
  store <8 x double> %535, ptr %503, align 64
  br label %536

536:
  %537 = select <8 x i1> %522, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %499
  %538 = add nuw nsw i64 %498, 1
  %539 = icmp eq i64 %538, %355
  br i1 %539, label %492, label %497

540:
  %541 = fdiv contract <8 x double> <double 3.000000e-01, double 3.000000e-01, double 3.000000e-01, double 3.000000e-01, double 3.000000e-01, double 3.000000e-01, double 3.000000e-01, double 3.000000e-01>, %552
  %542 = fcmp contract ogt <8 x double> %541, <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>
  %543 = select contract <8 x i1> %542, <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, <8 x double> %541
  %544 = icmp eq <8 x i64> %332, zeroinitializer
  br label %555

545:
  %546 = phi <8 x double> [ %552, %545 ], [ <double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11>, %492 ]
  %547 = phi i64 [ %553, %545 ], [ 0, %492 ]
  %548 = getelementptr inbounds [64 x <8 x double>], ptr %5, i64 0, i64 %547
  %549 = load <8 x double>, ptr %548, align 64
  %550 = call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %549)
  %551 = fcmp contract ogt <8 x double> %546, %550
  %552 = select contract <8 x i1> %551, <8 x double> %546, <8 x double> %550
  %553 = add nuw nsw i64 %547, 1
  %554 = icmp eq i64 %553, %355
  br i1 %554, label %540, label %545

555:
  %556 = phi i64 [ 0, %540 ], [ %582, %555 ]
  %557 = getelementptr inbounds <8 x double>, ptr %12, i64 %556
  %558 = load <8 x double>, ptr %557, align 64
  %559 = getelementptr inbounds [64 x <8 x double>], ptr %5, i64 0, i64 %556
  %560 = load <8 x double>, ptr %559, align 64
  %561 = fmul contract <8 x double> %543, %560
  %562 = fadd contract <8 x double> %558, %561
  %563 = getelementptr inbounds double, ptr %357, i64 %556
  %564 = load double, ptr %563, align 8
  %565 = insertelement <8 x double> poison, double %564, i64 0
  %566 = fadd contract <8 x double> %565, <double 0.000000e+00, double poison, double poison, double poison, double poison, double poison, double poison, double poison>
  %567 = shufflevector <8 x double> %566, <8 x double> poison, <8 x i32> zeroinitializer
  %568 = fcmp contract ogt <8 x double> %562, %567
  %569 = select contract <8 x i1> %568, <8 x double> %562, <8 x double> %567
  %570 = getelementptr inbounds double, ptr %358, i64 %556
  %571 = load double, ptr %570, align 8
  %572 = insertelement <8 x double> poison, double %571, i64 0
  %573 = fadd contract <8 x double> %572, <double 0.000000e+00, double poison, double poison, double poison, double poison, double poison, double poison, double poison>
  %574 = shufflevector <8 x double> %573, <8 x double> poison, <8 x i32> zeroinitializer
  %575 = fcmp contract olt <8 x double> %569, %574
  %576 = select contract <8 x i1> %575, <8 x double> %569, <8 x double> %574
  %577 = getelementptr inbounds [64 x <8 x double>], ptr %4, i64 0, i64 %556
  %578 = load <8 x double>, ptr %577, align 64
  %579 = fcmp contract ule <8 x double> %578, zeroinitializer
  %580 = select <8 x i1> %579, <8 x i1> <i1 true, i1 true, i1 true, i1 true, i1 true, i1 true, i1 true, i1 true>, <8 x i1> %544
  %581 = select contract <8 x i1> %580, <8 x double> %558, <8 x double> %576
  store <8 x double> %581, ptr %557, align 64
  %582 = add nuw nsw i64 %556, 1
  %583 = icmp eq i64 %582, %355
  br i1 %583, label %584, label %555

584:
  call void @llvm.lifetime.end.p0(i64 1536, ptr nonnull %7)
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %6)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %5)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %4)
  %585 = add nuw nsw i64 %326, 1
  br label %325

586:
  %587 = load i64, ptr %37, align 8
  %588 = call contract <8 x double> @llvm.sqrt.v8f64(<8 x double> %602)
  br label %662

589:
  %590 = phi <8 x double> [ zeroinitializer, %342 ], [ %602, %589 ]
  %591 = phi i64 [ 0, %342 ], [ %605, %589 ]
  %592 = phi <8 x double> [ zeroinitializer, %342 ], [ %604, %589 ]
  %593 = getelementptr inbounds <8 x double>, ptr %11, i64 %591
  %594 = load <8 x double>, ptr %593, align 64
  %595 = getelementptr inbounds double, ptr %343, i64 %591
  %596 = load double, ptr %595, align 8
  %597 = insertelement <8 x double> poison, double %596, i64 0
  %598 = shufflevector <8 x double> %597, <8 x double> poison, <8 x i32> zeroinitializer
  %599 = fmul contract <8 x double> %594, %598
  %600 = call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %599)
  %601 = fmul contract <8 x double> %599, %599
  %602 = fadd contract <8 x double> %590, %601
  %603 = fcmp contract ogt <8 x double> %592, %600
  %604 = select contract <8 x i1> %603, <8 x double> %592, <8 x double> %600
  %605 = add nuw nsw i64 %591, 1
  %606 = icmp eq i64 %605, %18
  br i1 %606, label %586, label %589

607:
  %608 = phi i64 [ 0, %308 ], [ %632, %607 ]
  %609 = getelementptr inbounds [64 x <8 x double>], ptr %8, i64 0, i64 %608
  %610 = load <8 x double>, ptr %609, align 64
  %611 = getelementptr inbounds [64 x <8 x double>], ptr %11, i64 0, i64 %608
  %612 = load <8 x double>, ptr %611, align 64
  %613 = fadd contract <8 x double> %610, %612
  %614 = getelementptr inbounds double, ptr %311, i64 %608
  %615 = load double, ptr %614, align 8
  %616 = insertelement <8 x double> poison, double %615, i64 0
  %617 = fadd contract <8 x double> %616, <double 0.000000e+00, double poison, double poison, double poison, double poison, double poison, double poison, double poison>
  %618 = shufflevector <8 x double> %617, <8 x double> poison, <8 x i32> zeroinitializer
  %619 = fcmp contract ogt <8 x double> %613, %618
  %620 = select contract <8 x i1> %619, <8 x double> %613, <8 x double> %618
  %621 = getelementptr inbounds double, ptr %312, i64 %608
  %622 = load double, ptr %621, align 8
  %623 = insertelement <8 x double> poison, double %622, i64 0
  %624 = fadd contract <8 x double> %623, <double 0.000000e+00, double poison, double poison, double poison, double poison, double poison, double poison, double poison>
  %625 = shufflevector <8 x double> %624, <8 x double> poison, <8 x i32> zeroinitializer
  %626 = fcmp contract olt <8 x double> %620, %625
  %627 = select contract <8 x i1> %626, <8 x double> %620, <8 x double> %625
  %628 = getelementptr inbounds [64 x <8 x double>], ptr %9, i64 0, i64 %608
  %629 = load <8 x double>, ptr %628, align 64
  %630 = select contract <8 x i1> %313, <8 x double> %627, <8 x double> %629
  %631 = getelementptr inbounds [64 x <8 x double>], ptr %12, i64 0, i64 %608
  store <8 x double> %630, ptr %631, align 64
  %632 = add nuw nsw i64 %608, 1
  %633 = icmp eq i64 %632, %18
  br i1 %633, label %322, label %607

634:
  %635 = select contract i1 %677, <8 x double> %588, <8 x double> %604
  br label %636

636:
  %637 = phi i1 [ %341, %339 ], [ %677, %634 ]
  %638 = phi <8 x double> [ zeroinitializer, %339 ], [ %635, %634 ]
  %639 = phi <8 x double> [ zeroinitializer, %339 ], [ %659, %634 ]
  %640 = phi <8 x double> [ zeroinitializer, %339 ], [ %657, %634 ]
  %641 = call contract <8 x double> @llvm.sqrt.v8f64(<8 x double> %640)
  %642 = select contract i1 %637, <8 x double> %641, <8 x double> %639
  %643 = fsub contract <8 x double> %169, %642
  br label %678

644:
  %645 = phi <8 x double> [ %657, %644 ], [ zeroinitializer, %676 ]
  %646 = phi i64 [ %660, %644 ], [ 0, %676 ]
  %647 = phi <8 x double> [ %659, %644 ], [ zeroinitializer, %676 ]
  %648 = getelementptr inbounds <8 x double>, ptr %10, i64 %646
  %649 = load <8 x double>, ptr %648, align 64
  %650 = getelementptr inbounds double, ptr %343, i64 %646
  %651 = load double, ptr %650, align 8
  %652 = insertelement <8 x double> poison, double %651, i64 0
  %653 = shufflevector <8 x double> %652, <8 x double> poison, <8 x i32> zeroinitializer
  %654 = fmul contract <8 x double> %649, %653
  %655 = call contract noundef <8 x double> @llvm.fabs.v8f64(<8 x double> %654)
  %656 = fmul contract <8 x double> %654, %654
  %657 = fadd contract <8 x double> %645, %656
  %658 = fcmp contract ogt <8 x double> %647, %655
  %659 = select contract <8 x i1> %658, <8 x double> %647, <8 x double> %655
  %660 = add nuw nsw i64 %646, 1
  %661 = icmp eq i64 %660, %18
  br i1 %661, label %634, label %644

662:
  %663 = phi i64 [ %674, %662 ], [ 0, %586 ]
  %664 = getelementptr inbounds [64 x <8 x double>], ptr %9, i64 0, i64 %663
  %665 = load <8 x double>, ptr %664, align 64
  %666 = getelementptr inbounds [64 x <8 x double>], ptr %12, i64 0, i64 %663
  %667 = load <8 x double>, ptr %666, align 64
  %668 = fsub contract <8 x double> %665, %667
  %669 = getelementptr inbounds [64 x <8 x double>], ptr %10, i64 0, i64 %663
  store <8 x double> %668, ptr %669, align 64
  %670 = getelementptr inbounds [64 x <8 x double>], ptr %8, i64 0, i64 %663
  %671 = load <8 x double>, ptr %670, align 64
  %672 = fsub contract <8 x double> %667, %671
  %673 = getelementptr inbounds [64 x <8 x double>], ptr %11, i64 0, i64 %663
  store <8 x double> %672, ptr %673, align 64
  %674 = add nuw nsw i64 %663, 1
  %675 = icmp eq i64 %674, %18
  br i1 %675, label %676, label %662

676:
  %677 = icmp eq i64 %587, 0
  br label %644

678:
  %679 = phi i64 [ %158, %636 ], [ %763, %762 ]
  %680 = phi i64 [ 0, %636 ], [ %764, %762 ]
  %681 = getelementptr inbounds [8 x i64], ptr %14, i64 0, i64 %680
  %682 = load i64, ptr %681, align 8
  %683 = icmp slt i64 %682, 0
  br i1 %683, label %762, label %684

684:
  call void @llvm.lifetime.start.p0(i64 512, ptr nonnull %16)
  call void @llvm.lifetime.start.p0(i64 512, ptr nonnull %17)
  br i1 %20, label %693, label %685

685:
  %686 = extractelement <8 x double> %169, i64 %680
  %687 = fcmp contract ogt double %686, 0.000000e+00
  %688 = extractelement <8 x double> %643, i64 %680
  %689 = extractelement <8 x double> %638, i64 %680
  %690 = fmul contract double %689, 1.000000e-01
  %691 = fcmp contract ogt double %688, %690
  %692 = and i1 %687, %691
  br i1 %692, label %705, label %715

693:
  %694 = phi i64 [ %703, %693 ], [ 0, %684 ]
  %695 = getelementptr inbounds [64 x <8 x double>], ptr %8, i64 0, i64 %694
  %696 = load <8 x double>, ptr %695, align 64
  %697 = extractelement <8 x double> %696, i64 %680
  %698 = getelementptr inbounds [64 x double], ptr %16, i64 0, i64 %694
  store double %697, ptr %698, align 8
  %699 = getelementptr inbounds [64 x <8 x double>], ptr %11, i64 0, i64 %694
  %700 = load <8 x double>, ptr %699, align 64
  %701 = extractelement <8 x double> %700, i64 %680
  %702 = getelementptr inbounds [64 x double], ptr %17, i64 0, i64 %694
  store double %701, ptr %702, align 8
  %703 = add nuw nsw i64 %694, 1
  %704 = icmp eq i64 %703, %18
  br i1 %704, label %685, label %693

705:
  %706 = load ptr, ptr %45, align 8
  %707 = call fastcc noundef zeroext i1 @_ZL17prove_constraintsRK8ManifoldPKdS3_S3_(ptr noundef nonnull align 8 dereferenceable(104) %0, ptr noundef nonnull %16, ptr noundef nonnull %17, ptr noundef %706)
  br i1 %707, label %708, label %715

708:
  br i1 %46, label %718, label %709

709:
  %710 = load ptr, ptr %45, align 8
  %711 = load double, ptr %47, align 8
  %712 = call fastcc noundef zeroext i1 @_ZL10prove_edgeRK5SceneIdEPKdS4_S4_d(ptr noundef nonnull readonly align 8 dereferenceable(136) %1, ptr noundef nonnull %16, ptr noundef nonnull %17, ptr noundef %710, double noundef %711)
  %713 = load ptr, ptr %29, align 8
  %714 = getelementptr inbounds i64, ptr %713, i64 %682
  br i1 %712, label %721, label %741

715:
  %716 = load ptr, ptr %29, align 8
  %717 = getelementptr inbounds i64, ptr %716, i64 %682
  br label %741

718:
  %719 = load ptr, ptr %29, align 8
  %720 = getelementptr inbounds i64, ptr %719, i64 %682
  br label %721

721:
  %722 = phi ptr [ %714, %709 ], [ %720, %718 ]
  br i1 %20, label %723, label %741

723:
  %724 = phi i64 [ %739, %723 ], [ 0, %721 ]
  %725 = getelementptr inbounds [64 x <8 x double>], ptr %12, i64 0, i64 %724
  %726 = load <8 x double>, ptr %725, align 64
  %727 = extractelement <8 x double> %726, i64 %680
  %728 = getelementptr inbounds [64 x <8 x double>], ptr %8, i64 0, i64 %724
  %729 = load <8 x double>, ptr %728, align 64
  %730 = insertelement <8 x double> %729, double %727, i64 %680
  store <8 x double> %730, ptr %728, align 64
  %731 = load ptr, ptr %48, align 8
  %732 = load i64, ptr %49, align 8
  %733 = mul nsw i64 %732, %682
  %734 = load i64, ptr %722, align 8
  %735 = add nsw i64 %733, %734
  %736 = mul nsw i64 %735, %18
  %737 = getelementptr double, ptr %731, i64 %736
  %738 = getelementptr double, ptr %737, i64 %724
  store double %727, ptr %738, align 8
  %739 = add nuw nsw i64 %724, 1
  %740 = icmp eq i64 %739, %18
  br i1 %740, label %741, label %723

741:
  %742 = phi ptr [ %717, %715 ], [ %714, %709 ], [ %722, %721 ], [ %722, %723 ]
  %743 = phi i1 [ false, %715 ], [ false, %709 ], [ true, %721 ], [ true, %723 ]
  %744 = zext i1 %743 to i64
  %745 = load i64, ptr %742, align 8
  %746 = add nsw i64 %745, %744
  store i64 %746, ptr %742, align 8
  %747 = extractelement <8 x i64> %323, i64 %680
  %748 = icmp eq i64 %747, 0
  %749 = select i1 %743, i1 %748, i1 false
  %750 = load i64, ptr %49, align 8
  %751 = icmp slt i64 %746, %750
  %752 = select i1 %749, i1 %751, i1 false
  br i1 %752, label %760, label %753

753:
  %754 = icmp ne i64 %747, 0
  %755 = select i1 %743, i1 %754, i1 false
  %756 = zext i1 %755 to i8
  %757 = load ptr, ptr %30, align 8
  %758 = getelementptr inbounds i8, ptr %757, i64 %682
  store i8 %756, ptr %758, align 1
  store i64 -1, ptr %681, align 8
  %759 = add nsw i64 %679, -1
  br label %760

760:
  %761 = phi i64 [ %759, %753 ], [ %679, %741 ]
  call void @llvm.lifetime.end.p0(i64 512, ptr nonnull %17)
  call void @llvm.lifetime.end.p0(i64 512, ptr nonnull %16)
  br label %762

762:
  %763 = phi i64 [ %679, %678 ], [ %761, %760 ]
  %764 = add nuw nsw i64 %680, 1
  %765 = icmp eq i64 %764, 8
  br i1 %765, label %766, label %678

766:
  br label %56

767:
  call void @llvm.lifetime.end.p0(i64 103168, ptr nonnull %15)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %14)
  call void @llvm.lifetime.end.p0(i64 1536, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %12)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %10)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %9)
  call void @llvm.lifetime.end.p0(i64 4096, ptr nonnull %8)
  ret void
}

define i64 @check_spans(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, i64 noundef %2, ptr nocapture noundef %3, i64 noundef %4, ptr nocapture noundef %5) {
  %7 = alloca [16 x double], align 16
  %8 = alloca [16 x double], align 16
  %9 = alloca [16 x double], align 16
  %10 = alloca [16 x double], align 16
  %11 = alloca [16 x double], align 16
  %12 = alloca [16 x double], align 16
  %13 = alloca [192 x %struct.Point], align 64
  %14 = alloca [2 x i64], align 16
  %15 = alloca [9 x <16 x float>], align 64
  %16 = alloca [16 x <16 x float>], align 64
  %17 = alloca [16 x <16 x float>], align 64
  %18 = alloca [16 x <16 x float>], align 64
  %19 = alloca [17 x <16 x float>], align 64
  %20 = alloca [136 x <16 x float>], align 64
  %21 = alloca [16 x <16 x float>], align 64
  %22 = alloca [16 x <16 x float>], align 64
  %23 = alloca [16 x <16 x float>], align 64
  %24 = alloca [16 x <16 x float>], align 64
  %25 = alloca [16 x float], align 16
  %26 = alloca [16 x float], align 16
  %27 = alloca [17 x %struct.Frame], align 64
  %28 = alloca [17 x [17 x <16 x float>]], align 64
  %29 = alloca [17 x [17 x <16 x float>]], align 64
  %30 = alloca [4096 x %struct.SpanPiece], align 16
  %31 = alloca [16 x %struct.SpanPiece], align 16
  call void @llvm.lifetime.start.p0(i64 65536, ptr nonnull %30)
  %32 = icmp sgt i64 %2, 0
  br i1 %32, label %56, label %1817

33:
  br i1 %32, label %34, label %1817

34:
  %35 = getelementptr inbounds i8, ptr %1, i64 8
  %36 = getelementptr inbounds i8, ptr %1, i64 24
  %37 = getelementptr inbounds i8, ptr %1, i64 16
  %38 = getelementptr inbounds i8, ptr %1, i64 36
  %39 = getelementptr inbounds i8, ptr %0, i64 24
  %40 = getelementptr inbounds i8, ptr %27, i64 576
  %41 = getelementptr inbounds i8, ptr %1, i64 32
  %42 = getelementptr inbounds i8, ptr %0, i64 88
  %43 = getelementptr inbounds i8, ptr %0, i64 16
  %44 = getelementptr inbounds i8, ptr %0, i64 96
  %45 = getelementptr inbounds i8, ptr %0, i64 48
  %46 = getelementptr inbounds i8, ptr %0, i64 8
  %47 = getelementptr inbounds i8, ptr %0, i64 56
  %48 = getelementptr inbounds i8, ptr %0, i64 64
  %49 = getelementptr inbounds i8, ptr %0, i64 32
  %50 = getelementptr inbounds i8, ptr %0, i64 40
  %51 = getelementptr inbounds i8, ptr %0, i64 128
  %52 = getelementptr inbounds i8, ptr %14, i64 8
  %53 = getelementptr inbounds i8, ptr %0, i64 80
  %54 = getelementptr inbounds i8, ptr %0, i64 72
  %55 = getelementptr inbounds i8, ptr %0, i64 104
  br label %61

56:
  %57 = phi i64 [ %59, %56 ], [ 0, %6 ]
  %58 = getelementptr inbounds i8, ptr %5, i64 %57
  store i8 0, ptr %58, align 1
  %59 = add nuw nsw i64 %57, 1
  %60 = icmp eq i64 %59, %2
  br i1 %60, label %33, label %56

61:
  %62 = phi i64 [ 0, %34 ], [ %1813, %1812 ]
  %63 = phi i64 [ 0, %34 ], [ %108, %1812 ]
  %64 = phi i64 [ 0, %34 ], [ %1763, %1812 ]
  call void @llvm.lifetime.start.p0(i64 256, ptr nonnull %31)
  %65 = icmp sgt i64 %62, 15
  %66 = add nsw i64 %63, 16
  %67 = icmp sgt i64 %66, %2
  %68 = select i1 %65, i1 true, i1 %67
  br label %69

69:
  %70 = phi i64 [ %62, %61 ], [ %93, %88 ]
  %71 = phi i64 [ %63, %61 ], [ %92, %88 ]
  %72 = phi i64 [ 0, %61 ], [ %101, %88 ]
  %73 = icmp ne i64 %70, 0
  %74 = icmp slt i64 %71, %2
  %75 = select i1 %73, i1 true, i1 %74
  br i1 %75, label %76, label %103

76:
  %77 = and i1 %68, %73
  br i1 %77, label %80, label %78

78:
  %79 = add nsw i64 %71, 1
  br label %88

80:
  %81 = add nsw i64 %70, -1
  %82 = getelementptr inbounds [4096 x %struct.SpanPiece], ptr %30, i64 0, i64 %81
  %83 = load i64, ptr %82, align 16
  %84 = getelementptr inbounds i8, ptr %82, i64 8
  %85 = load float, ptr %84, align 8
  %86 = getelementptr inbounds i8, ptr %82, i64 12
  %87 = load float, ptr %86, align 4
  br label %88

88:
  %89 = phi i64 [ %83, %80 ], [ %71, %78 ]
  %90 = phi float [ %85, %80 ], [ 0.000000e+00, %78 ]
  %91 = phi float [ %87, %80 ], [ 1.000000e+00, %78 ]
  %92 = phi i64 [ %71, %80 ], [ %79, %78 ]
  %93 = phi i64 [ %81, %80 ], [ %70, %78 ]
  %94 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %72
  store i64 %89, ptr %94, align 16
  %95 = getelementptr inbounds i8, ptr %94, i64 8
  store float %90, ptr %95, align 8
  %96 = getelementptr inbounds i8, ptr %94, i64 12
  store float %91, ptr %96, align 4
  %97 = getelementptr inbounds i8, ptr %5, i64 %89
  %98 = load i8, ptr %97, align 1
  %99 = icmp eq i8 %98, 0
  %100 = zext i1 %99 to i64
  %101 = add nuw nsw i64 %72, %100
  %102 = icmp ult i64 %101, 16
  br i1 %102, label %69, label %106

103:
  %104 = icmp eq i64 %72, 0
  br i1 %104, label %105, label %1770

105:
  call void @llvm.lifetime.end.p0(i64 256, ptr nonnull %31)
  br label %1817

106:
  %107 = phi i64 [ %72, %1770 ], [ 16, %88 ]
  %108 = phi i64 [ %71, %1770 ], [ %92, %88 ]
  %109 = phi i64 [ 0, %1770 ], [ %93, %88 ]
  %110 = shl nsw i64 -1, %107
  %111 = xor i64 %110, -1
  %112 = load i64, ptr %0, align 8
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %16)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %17)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %18)
  call void @llvm.lifetime.start.p0(i64 1088, ptr nonnull %19)
  call void @llvm.lifetime.start.p0(i64 8704, ptr nonnull %20)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %21)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %22)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %23)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %24)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %25)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %26)
  br label %161

113:
  %114 = icmp sgt i64 %109, 4064
  %115 = load <16 x float>, ptr %25, align 16
  %116 = load <16 x float>, ptr %26, align 16
  %117 = fsub contract <16 x float> %116, %115
  %118 = load ptr, ptr %35, align 8
  %119 = load i64, ptr %36, align 8
  %120 = load i64, ptr %37, align 8
  %121 = mul nsw i64 %120, %119
  %122 = getelementptr inbounds double, ptr %118, i64 %121
  br i1 %68, label %123, label %133

123:
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %12)
  br label %124

124:
  %125 = phi i64 [ 0, %123 ], [ %131, %124 ]
  %126 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %125
  %127 = load i64, ptr %126, align 16
  %128 = getelementptr inbounds double, ptr %122, i64 %127
  %129 = load double, ptr %128, align 8
  %130 = getelementptr inbounds [16 x double], ptr %12, i64 0, i64 %125
  store double %129, ptr %130, align 8
  %131 = add nuw nsw i64 %125, 1
  %132 = icmp eq i64 %131, 16
  br i1 %132, label %141, label %124

133:
  %134 = load ptr, ptr %1, align 8
  %135 = load i64, ptr %31, align 16
  %136 = getelementptr inbounds double, ptr %122, i64 %135
  %137 = load <16 x double>, ptr %136, align 8
  %138 = getelementptr inbounds double, ptr %134, i64 %121
  %139 = getelementptr inbounds double, ptr %138, i64 %135
  %140 = load <16 x double>, ptr %139, align 8
  br label %156

141:
  %142 = load <16 x double>, ptr %12, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %12)
  %143 = load ptr, ptr %1, align 8
  %144 = getelementptr inbounds double, ptr %143, i64 %121
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %11)
  br label %147

145:
  %146 = load <16 x double>, ptr %11, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %11)
  br label %156

147:
  %148 = phi i64 [ 0, %141 ], [ %154, %147 ]
  %149 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %148
  %150 = load i64, ptr %149, align 16
  %151 = getelementptr inbounds double, ptr %144, i64 %150
  %152 = load double, ptr %151, align 8
  %153 = getelementptr inbounds [16 x double], ptr %11, i64 0, i64 %148
  store double %152, ptr %153, align 8
  %154 = add nuw nsw i64 %148, 1
  %155 = icmp eq i64 %154, 16
  br i1 %155, label %145, label %147

156:
  %157 = phi ptr [ %134, %133 ], [ %143, %145 ]
  %158 = phi <16 x double> [ %137, %133 ], [ %142, %145 ]
  %159 = phi <16 x double> [ %140, %133 ], [ %146, %145 ]
  %160 = fsub contract <16 x double> %158, %159
  br i1 %114, label %180, label %171

161:
  %162 = phi i64 [ 0, %106 ], [ %169, %161 ]
  %163 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %162, i32 1
  %164 = load float, ptr %163, align 8
  %165 = getelementptr inbounds [16 x float], ptr %25, i64 0, i64 %162
  store float %164, ptr %165, align 4
  %166 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %162, i32 2
  %167 = load float, ptr %166, align 4
  %168 = getelementptr inbounds [16 x float], ptr %26, i64 0, i64 %162
  store float %167, ptr %168, align 4
  %169 = add nuw nsw i64 %162, 1
  %170 = icmp eq i64 %169, 16
  br i1 %170, label %113, label %161

171:
  %172 = fptrunc <16 x double> %160 to <16 x float>
  %173 = fmul contract <16 x float> %117, %172
  %174 = load float, ptr %38, align 4
  %175 = insertelement <16 x float> poison, float %174, i64 0
  %176 = shufflevector <16 x float> %175, <16 x float> poison, <16 x i32> zeroinitializer
  %177 = fcmp contract ole <16 x float> %173, %176
  %178 = bitcast <16 x i1> %177 to i16
  %179 = zext i16 %178 to i64
  br label %180

180:
  %181 = phi i64 [ %179, %171 ], [ -1, %156 ]
  %182 = icmp sgt i64 %112, 0
  br i1 %182, label %183, label %294

183:
  %184 = load i64, ptr %31, align 16
  %185 = load ptr, ptr %39, align 8
  %186 = getelementptr double, ptr %157, i64 %184
  %187 = getelementptr double, ptr %118, i64 %184
  br label %193

188:
  br i1 %182, label %189, label %294

189:
  %190 = fmul contract <16 x float> %115, <float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00>
  %191 = fmul contract <16 x float> %116, <float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00>
  %192 = fdiv contract <16 x float> %117, <float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00>
  br label %504

193:
  %194 = phi i64 [ 0, %183 ], [ %292, %287 ]
  %195 = mul nsw i64 %194, %120
  %196 = getelementptr inbounds double, ptr %157, i64 %195
  br i1 %68, label %200, label %197

197:
  %198 = getelementptr inbounds double, ptr %196, i64 %184
  %199 = load <16 x double>, ptr %198, align 8
  br label %212

200:
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %10)
  br label %203

201:
  %202 = load <16 x double>, ptr %10, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %10)
  br label %212

203:
  %204 = phi i64 [ 0, %200 ], [ %210, %203 ]
  %205 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %204
  %206 = load i64, ptr %205, align 16
  %207 = getelementptr inbounds double, ptr %196, i64 %206
  %208 = load double, ptr %207, align 8
  %209 = getelementptr inbounds [16 x double], ptr %10, i64 0, i64 %204
  store double %208, ptr %209, align 8
  %210 = add nuw nsw i64 %204, 1
  %211 = icmp eq i64 %210, 16
  br i1 %211, label %201, label %203

212:
  %213 = phi <16 x double> [ %199, %197 ], [ %202, %201 ]
  %214 = getelementptr inbounds %struct.Joint, ptr %185, i64 %194, i32 2
  %215 = load float, ptr %214, align 4
  %216 = fcmp contract une float %215, 0.000000e+00
  br i1 %216, label %223, label %217

217:
  %218 = fmul contract <16 x double> %213, <double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883>
  %219 = fadd contract <16 x double> %218, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %220 = fadd contract <16 x double> %219, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %221 = fmul contract <16 x double> %220, <double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18>
  %222 = fsub contract <16 x double> %213, %221
  br label %223

223:
  %224 = phi contract <16 x double> [ %222, %217 ], [ %213, %212 ]
  %225 = fptrunc <16 x double> %224 to <16 x float>
  %226 = getelementptr inbounds [16 x <16 x float>], ptr %21, i64 0, i64 %194
  store <16 x float> %225, ptr %226, align 64
  %227 = getelementptr inbounds double, ptr %118, i64 %195
  br i1 %68, label %228, label %255

228:
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %9)
  br label %229

229:
  %230 = phi i64 [ 0, %228 ], [ %236, %229 ]
  %231 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %230
  %232 = load i64, ptr %231, align 16
  %233 = getelementptr inbounds double, ptr %227, i64 %232
  %234 = load double, ptr %233, align 8
  %235 = getelementptr inbounds [16 x double], ptr %9, i64 0, i64 %230
  store double %234, ptr %235, align 8
  %236 = add nuw nsw i64 %230, 1
  %237 = icmp eq i64 %236, 16
  br i1 %237, label %238, label %229

238:
  %239 = load <16 x double>, ptr %9, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %9)
  %240 = fsub contract <16 x double> %239, %213
  %241 = fptrunc <16 x double> %240 to <16 x float>
  %242 = getelementptr inbounds [16 x <16 x float>], ptr %23, i64 0, i64 %194
  store <16 x float> %241, ptr %242, align 64
  %243 = add nuw nsw i64 %194, %112
  %244 = mul nsw i64 %243, %120
  %245 = getelementptr inbounds double, ptr %157, i64 %244
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %8)
  br label %246

246:
  %247 = phi i64 [ 0, %238 ], [ %253, %246 ]
  %248 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %247
  %249 = load i64, ptr %248, align 16
  %250 = getelementptr inbounds double, ptr %245, i64 %249
  %251 = load double, ptr %250, align 8
  %252 = getelementptr inbounds [16 x double], ptr %8, i64 0, i64 %247
  store double %251, ptr %252, align 8
  %253 = add nuw nsw i64 %247, 1
  %254 = icmp eq i64 %253, 16
  br i1 %254, label %270, label %246

255:
  %256 = getelementptr inbounds double, ptr %227, i64 %184
  %257 = load <16 x double>, ptr %256, align 8
  %258 = fsub contract <16 x double> %257, %213
  %259 = fptrunc <16 x double> %258 to <16 x float>
  %260 = getelementptr inbounds [16 x <16 x float>], ptr %23, i64 0, i64 %194
  store <16 x float> %259, ptr %260, align 64
  %261 = add nuw nsw i64 %194, %112
  %262 = mul nsw i64 %261, %120
  %263 = getelementptr double, ptr %186, i64 %262
  %264 = load <16 x double>, ptr %263, align 8
  %265 = fmul contract <16 x double> %160, %264
  %266 = fptrunc <16 x double> %265 to <16 x float>
  %267 = getelementptr inbounds [16 x <16 x float>], ptr %22, i64 0, i64 %194
  store <16 x float> %266, ptr %267, align 64
  %268 = getelementptr double, ptr %187, i64 %262
  %269 = load <16 x double>, ptr %268, align 8
  br label %287

270:
  %271 = load <16 x double>, ptr %8, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %8)
  %272 = fmul contract <16 x double> %160, %271
  %273 = fptrunc <16 x double> %272 to <16 x float>
  %274 = getelementptr inbounds [16 x <16 x float>], ptr %22, i64 0, i64 %194
  store <16 x float> %273, ptr %274, align 64
  %275 = getelementptr inbounds double, ptr %118, i64 %244
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %7)
  br label %278

276:
  %277 = load <16 x double>, ptr %7, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %7)
  br label %287

278:
  %279 = phi i64 [ 0, %270 ], [ %285, %278 ]
  %280 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %279
  %281 = load i64, ptr %280, align 16
  %282 = getelementptr inbounds double, ptr %275, i64 %281
  %283 = load double, ptr %282, align 8
  %284 = getelementptr inbounds [16 x double], ptr %7, i64 0, i64 %279
  store double %283, ptr %284, align 8
  %285 = add nuw nsw i64 %279, 1
  %286 = icmp eq i64 %285, 16
  br i1 %286, label %276, label %278

287:
  %288 = phi <16 x double> [ %269, %255 ], [ %277, %276 ]
  %289 = fmul contract <16 x double> %160, %288
  %290 = fptrunc <16 x double> %289 to <16 x float>
  %291 = getelementptr inbounds [16 x <16 x float>], ptr %24, i64 0, i64 %194
  store <16 x float> %290, ptr %291, align 64
  %292 = add nuw nsw i64 %194, 1
  %293 = icmp eq i64 %292, %112
  br i1 %293, label %188, label %193

294:
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %27)
  %295 = load ptr, ptr %39, align 8
  br label %296

296:
  %297 = phi i64 [ 0, %294 ], [ %304, %296 ]
  %298 = and i64 %297, 3
  %299 = icmp eq i64 %298, 0
  %300 = uitofp i1 %299 to float
  %301 = insertelement <16 x float> poison, float %300, i64 0
  %302 = shufflevector <16 x float> %301, <16 x float> poison, <16 x i32> zeroinitializer
  %303 = getelementptr inbounds [9 x <16 x float>], ptr %27, i64 0, i64 %297
  store <16 x float> %302, ptr %303, align 64
  %304 = add nuw nsw i64 %297, 1
  %305 = icmp eq i64 %304, 9
  br i1 %305, label %308, label %296

306:
  br i1 %182, label %313, label %307

307:
  call void @llvm.lifetime.start.p0(i64 18496, ptr nonnull %28)
  call void @llvm.lifetime.start.p0(i64 18496, ptr nonnull %29)
  br label %576

308:
  %309 = phi i64 [ %311, %308 ], [ 0, %296 ]
  %310 = getelementptr inbounds [3 x <16 x float>], ptr %40, i64 0, i64 %309
  store <16 x float> zeroinitializer, ptr %310, align 64
  %311 = add nuw nsw i64 %309, 1
  %312 = icmp eq i64 %311, 3
  br i1 %312, label %306, label %308

313:
  %314 = phi i64 [ %317, %501 ], [ 0, %306 ]
  %315 = getelementptr inbounds %struct.Joint, ptr %295, i64 %314
  %316 = getelementptr inbounds %struct.Frame, ptr %27, i64 %314
  %317 = add nuw nsw i64 %314, 1
  %318 = getelementptr inbounds <16 x float>, ptr %16, i64 %314
  %319 = load <16 x float>, ptr %318, align 64
  %320 = getelementptr inbounds i8, ptr %315, i64 36
  %321 = load float, ptr %320, align 4
  %322 = getelementptr inbounds i8, ptr %315, i64 40
  %323 = load float, ptr %322, align 4
  %324 = getelementptr inbounds i8, ptr %315, i64 44
  %325 = load float, ptr %324, align 4
  %326 = getelementptr inbounds i8, ptr %316, i64 576
  %327 = load <16 x float>, ptr %326, align 64
  %328 = load <16 x float>, ptr %316, align 64
  %329 = insertelement <16 x float> poison, float %321, i64 0
  %330 = shufflevector <16 x float> %329, <16 x float> poison, <16 x i32> zeroinitializer
  %331 = fmul contract <16 x float> %330, %328
  %332 = getelementptr inbounds i8, ptr %316, i64 64
  %333 = load <16 x float>, ptr %332, align 64
  %334 = insertelement <16 x float> poison, float %323, i64 0
  %335 = shufflevector <16 x float> %334, <16 x float> poison, <16 x i32> zeroinitializer
  %336 = fmul contract <16 x float> %335, %333
  %337 = getelementptr inbounds i8, ptr %316, i64 128
  %338 = load <16 x float>, ptr %337, align 64
  %339 = insertelement <16 x float> poison, float %325, i64 0
  %340 = shufflevector <16 x float> %339, <16 x float> poison, <16 x i32> zeroinitializer
  %341 = fmul contract <16 x float> %340, %338
  %342 = getelementptr inbounds i8, ptr %316, i64 640
  %343 = load <16 x float>, ptr %342, align 64
  %344 = getelementptr inbounds i8, ptr %316, i64 192
  %345 = load <16 x float>, ptr %344, align 64
  %346 = fmul contract <16 x float> %330, %345
  %347 = getelementptr inbounds i8, ptr %316, i64 256
  %348 = load <16 x float>, ptr %347, align 64
  %349 = fmul contract <16 x float> %335, %348
  %350 = getelementptr inbounds i8, ptr %316, i64 320
  %351 = load <16 x float>, ptr %350, align 64
  %352 = fmul contract <16 x float> %340, %351
  %353 = getelementptr inbounds i8, ptr %316, i64 704
  %354 = load <16 x float>, ptr %353, align 64
  %355 = getelementptr inbounds i8, ptr %316, i64 384
  %356 = load <16 x float>, ptr %355, align 64
  %357 = fmul contract <16 x float> %330, %356
  %358 = getelementptr inbounds i8, ptr %316, i64 448
  %359 = load <16 x float>, ptr %358, align 64
  %360 = fmul contract <16 x float> %335, %359
  %361 = getelementptr inbounds i8, ptr %316, i64 512
  %362 = load <16 x float>, ptr %361, align 64
  %363 = fmul contract <16 x float> %340, %362
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %15)
  br label %364

364:
  %365 = phi i64 [ 0, %313 ], [ %393, %392 ]
  %366 = mul nuw nsw i64 %365, 3
  %367 = getelementptr inbounds [9 x <16 x float>], ptr %316, i64 0, i64 %366
  %368 = load <16 x float>, ptr %367, align 64
  %369 = add nuw nsw i64 %366, 1
  %370 = getelementptr inbounds [9 x <16 x float>], ptr %316, i64 0, i64 %369
  %371 = load <16 x float>, ptr %370, align 64
  %372 = add nuw nsw i64 %366, 2
  %373 = getelementptr inbounds [9 x <16 x float>], ptr %316, i64 0, i64 %372
  %374 = load <16 x float>, ptr %373, align 64
  br label %395

375:
  %376 = getelementptr inbounds %struct.Frame, ptr %27, i64 %317
  %377 = fadd contract <16 x float> %327, %331
  %378 = fadd contract <16 x float> %377, %336
  %379 = fadd contract <16 x float> %378, %341
  %380 = fadd contract <16 x float> %343, %346
  %381 = fadd contract <16 x float> %380, %349
  %382 = fadd contract <16 x float> %381, %352
  %383 = fadd contract <16 x float> %354, %357
  %384 = fadd contract <16 x float> %383, %360
  %385 = fadd contract <16 x float> %384, %363
  %386 = getelementptr inbounds i8, ptr %376, i64 576
  store <16 x float> %379, ptr %386, align 64
  %387 = getelementptr inbounds i8, ptr %376, i64 640
  store <16 x float> %382, ptr %387, align 64
  %388 = getelementptr inbounds i8, ptr %376, i64 704
  store <16 x float> %385, ptr %388, align 64
  %389 = getelementptr inbounds i8, ptr %315, i64 48
  %390 = load float, ptr %389, align 4
  %391 = fcmp contract une float %390, 0.000000e+00
  br i1 %391, label %420, label %439

392:
  %393 = add nuw nsw i64 %365, 1
  %394 = icmp eq i64 %393, 3
  br i1 %394, label %375, label %364

395:
  %396 = phi i64 [ 0, %364 ], [ %418, %395 ]
  %397 = getelementptr inbounds [9 x float], ptr %315, i64 0, i64 %396
  %398 = load float, ptr %397, align 4
  %399 = insertelement <16 x float> poison, float %398, i64 0
  %400 = shufflevector <16 x float> %399, <16 x float> poison, <16 x i32> zeroinitializer
  %401 = fmul contract <16 x float> %368, %400
  %402 = add nuw nsw i64 %396, 3
  %403 = getelementptr inbounds [9 x float], ptr %315, i64 0, i64 %402
  %404 = load float, ptr %403, align 4
  %405 = insertelement <16 x float> poison, float %404, i64 0
  %406 = shufflevector <16 x float> %405, <16 x float> poison, <16 x i32> zeroinitializer
  %407 = fmul contract <16 x float> %371, %406
  %408 = fadd contract <16 x float> %401, %407
  %409 = add nuw nsw i64 %396, 6
  %410 = getelementptr inbounds [9 x float], ptr %315, i64 0, i64 %409
  %411 = load float, ptr %410, align 4
  %412 = insertelement <16 x float> poison, float %411, i64 0
  %413 = shufflevector <16 x float> %412, <16 x float> poison, <16 x i32> zeroinitializer
  %414 = fmul contract <16 x float> %374, %413
  %415 = fadd contract <16 x float> %408, %414
  %416 = add nuw nsw i64 %396, %366
  %417 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %416
  store <16 x float> %415, ptr %417, align 64
  %418 = add nuw nsw i64 %396, 1
  %419 = icmp eq i64 %418, 3
  br i1 %419, label %392, label %395

420:
  %421 = phi i64 [ %425, %420 ], [ 0, %375 ]
  %422 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %421
  %423 = load <16 x float>, ptr %422, align 64
  %424 = getelementptr inbounds [9 x <16 x float>], ptr %376, i64 0, i64 %421
  store <16 x float> %423, ptr %424, align 64
  %425 = add nuw nsw i64 %421, 1
  %426 = icmp eq i64 %425, 9
  br i1 %426, label %427, label %420

427:
  %428 = phi i64 [ %437, %427 ], [ 0, %420 ]
  %429 = mul nuw nsw i64 %428, 3
  %430 = add nuw nsw i64 %429, 2
  %431 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %430
  %432 = load <16 x float>, ptr %431, align 64
  %433 = fmul contract <16 x float> %319, %432
  %434 = getelementptr inbounds [3 x <16 x float>], ptr %386, i64 0, i64 %428
  %435 = load <16 x float>, ptr %434, align 64
  %436 = fadd contract <16 x float> %435, %433
  store <16 x float> %436, ptr %434, align 64
  %437 = add nuw nsw i64 %428, 1
  %438 = icmp eq i64 %437, 3
  br i1 %438, label %501, label %427

439:
  %440 = fmul contract <16 x float> %319, <float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000>
  %441 = fadd contract <16 x float> %440, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %442 = fadd contract <16 x float> %441, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %443 = fmul contract <16 x float> %442, <float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000>
  %444 = fsub contract <16 x float> %319, %443
  %445 = fmul contract <16 x float> %442, <float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000>
  %446 = fsub contract <16 x float> %444, %445
  %447 = fmul contract <16 x float> %442, <float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000>
  %448 = fsub contract <16 x float> %446, %447
  %449 = fmul contract <16 x float> %442, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %450 = fadd contract <16 x float> %449, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %451 = fadd contract <16 x float> %450, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %452 = fsub contract <16 x float> %449, %451
  %453 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %452)
  %454 = fmul contract <16 x float> %453, <float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00>
  %455 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %454
  %456 = fmul contract <16 x float> %448, %448
  %457 = fmul contract <16 x float> %448, %456
  %458 = fmul contract <16 x float> %456, <float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000>
  %459 = fadd contract <16 x float> %458, <float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000>
  %460 = fmul contract <16 x float> %456, %459
  %461 = fadd contract <16 x float> %460, <float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000>
  %462 = fmul contract <16 x float> %456, %461
  %463 = fadd contract <16 x float> %462, <float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000>
  %464 = fmul contract <16 x float> %457, %463
  %465 = fadd contract <16 x float> %448, %464
  %466 = fmul contract <16 x float> %455, %465
  %467 = fmul contract <16 x float> %456, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %468 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %467
  %469 = fmul contract <16 x float> %456, %456
  %470 = fmul contract <16 x float> %456, <float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000>
  %471 = fsub contract <16 x float> <float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000>, %470
  %472 = fmul contract <16 x float> %456, %471
  %473 = fadd contract <16 x float> %472, <float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000>
  %474 = fmul contract <16 x float> %456, %473
  %475 = fadd contract <16 x float> %474, <float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000>
  %476 = fmul contract <16 x float> %469, %475
  %477 = fadd contract <16 x float> %468, %476
  %478 = fmul contract <16 x float> %455, %477
  br label %479

479:
  %480 = phi i64 [ 0, %439 ], [ %499, %479 ]
  %481 = mul nuw nsw i64 %480, 3
  %482 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %481
  %483 = load <16 x float>, ptr %482, align 64
  %484 = fmul contract <16 x float> %478, %483
  %485 = add nuw nsw i64 %481, 1
  %486 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %485
  %487 = load <16 x float>, ptr %486, align 64
  %488 = fmul contract <16 x float> %466, %487
  %489 = fadd contract <16 x float> %484, %488
  %490 = getelementptr inbounds [9 x <16 x float>], ptr %376, i64 0, i64 %481
  store <16 x float> %489, ptr %490, align 64
  %491 = fmul contract <16 x float> %478, %487
  %492 = fmul contract <16 x float> %466, %483
  %493 = fsub contract <16 x float> %491, %492
  %494 = getelementptr inbounds [9 x <16 x float>], ptr %376, i64 0, i64 %485
  store <16 x float> %493, ptr %494, align 64
  %495 = add nuw nsw i64 %481, 2
  %496 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %495
  %497 = load <16 x float>, ptr %496, align 64
  %498 = getelementptr inbounds [9 x <16 x float>], ptr %376, i64 0, i64 %495
  store <16 x float> %497, ptr %498, align 64
  %499 = add nuw nsw i64 %480, 1
  %500 = icmp eq i64 %499, 3
  br i1 %500, label %501, label %479

501:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %15)
  %502 = icmp eq i64 %317, %112
  br i1 %502, label %503, label %313

503:
  call void @llvm.lifetime.start.p0(i64 18496, ptr nonnull %28)
  call void @llvm.lifetime.start.p0(i64 18496, ptr nonnull %29)
  br i1 %182, label %593, label %576

504:
  %505 = phi i64 [ 0, %189 ], [ %574, %504 ]
  %506 = getelementptr inbounds [16 x <16 x float>], ptr %23, i64 0, i64 %505
  %507 = load <16 x float>, ptr %506, align 64
  %508 = fmul contract <16 x float> %507, <float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00>
  %509 = getelementptr inbounds [16 x <16 x float>], ptr %22, i64 0, i64 %505
  %510 = load <16 x float>, ptr %509, align 64
  %511 = fmul contract <16 x float> %510, <float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00>
  %512 = fsub contract <16 x float> %508, %511
  %513 = getelementptr inbounds [16 x <16 x float>], ptr %24, i64 0, i64 %505
  %514 = load <16 x float>, ptr %513, align 64
  %515 = fsub contract <16 x float> %512, %514
  %516 = fadd contract <16 x float> %510, %514
  %517 = fmul contract <16 x float> %507, <float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00>
  %518 = fsub contract <16 x float> %516, %517
  %519 = fmul contract <16 x float> %115, %518
  %520 = fadd contract <16 x float> %515, %519
  %521 = fmul contract <16 x float> %115, %520
  %522 = fadd contract <16 x float> %510, %521
  %523 = fmul contract <16 x float> %115, %522
  %524 = fmul contract <16 x float> %116, %518
  %525 = fadd contract <16 x float> %515, %524
  %526 = fmul contract <16 x float> %116, %525
  %527 = fadd contract <16 x float> %510, %526
  %528 = fmul contract <16 x float> %116, %527
  %529 = fmul contract <16 x float> %515, <float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00>
  %530 = fmul contract <16 x float> %190, %518
  %531 = fadd contract <16 x float> %529, %530
  %532 = fmul contract <16 x float> %115, %531
  %533 = fadd contract <16 x float> %510, %532
  %534 = fmul contract <16 x float> %191, %518
  %535 = fadd contract <16 x float> %529, %534
  %536 = fmul contract <16 x float> %116, %535
  %537 = fadd contract <16 x float> %510, %536
  %538 = fadd contract <16 x float> %515, %530
  %539 = fmul contract <16 x float> %117, %538
  %540 = fadd contract <16 x float> %539, %533
  %541 = fmul contract <16 x float> %192, %533
  %542 = fadd contract <16 x float> %523, %541
  %543 = fmul contract <16 x float> %192, %537
  %544 = fsub contract <16 x float> %528, %543
  %545 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %533)
  %546 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %540)
  %547 = fcmp contract ogt <16 x float> %545, %546
  %548 = select contract <16 x i1> %547, <16 x float> %545, <16 x float> %546
  %549 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %537)
  %550 = fcmp contract ogt <16 x float> %548, %549
  %551 = select contract <16 x i1> %550, <16 x float> %548, <16 x float> %549
  %552 = getelementptr inbounds [16 x <16 x float>], ptr %18, i64 0, i64 %505
  store <16 x float> %551, ptr %552, align 64
  %553 = fcmp contract olt <16 x float> %523, %542
  %554 = select contract <16 x i1> %553, <16 x float> %523, <16 x float> %542
  %555 = fcmp contract olt <16 x float> %544, %528
  %556 = select contract <16 x i1> %555, <16 x float> %544, <16 x float> %528
  %557 = fcmp contract olt <16 x float> %554, %556
  %558 = select contract <16 x i1> %557, <16 x float> %554, <16 x float> %556
  %559 = fcmp contract ogt <16 x float> %523, %542
  %560 = select contract <16 x i1> %559, <16 x float> %523, <16 x float> %542
  %561 = fcmp contract ogt <16 x float> %544, %528
  %562 = select contract <16 x i1> %561, <16 x float> %544, <16 x float> %528
  %563 = fcmp contract ogt <16 x float> %560, %562
  %564 = select contract <16 x i1> %563, <16 x float> %560, <16 x float> %562
  %565 = getelementptr inbounds [16 x <16 x float>], ptr %21, i64 0, i64 %505
  %566 = load <16 x float>, ptr %565, align 64
  %567 = fadd contract <16 x float> %558, %564
  %568 = fmul contract <16 x float> %567, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %569 = fadd contract <16 x float> %566, %568
  %570 = getelementptr inbounds [16 x <16 x float>], ptr %16, i64 0, i64 %505
  store <16 x float> %569, ptr %570, align 64
  %571 = fsub contract <16 x float> %564, %558
  %572 = fmul contract <16 x float> %571, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %573 = getelementptr inbounds [16 x <16 x float>], ptr %17, i64 0, i64 %505
  store <16 x float> %572, ptr %573, align 64
  %574 = add nuw nsw i64 %505, 1
  %575 = icmp eq i64 %574, %112
  br i1 %575, label %294, label %504

576:
  %577 = phi <16 x float> [ zeroinitializer, %503 ], [ zeroinitializer, %307 ], [ %608, %607 ]
  %578 = phi <16 x float> [ zeroinitializer, %503 ], [ zeroinitializer, %307 ], [ %609, %607 ]
  %579 = fcmp contract oeq <16 x float> %117, zeroinitializer
  %580 = load float, ptr %41, align 8
  %581 = insertelement <16 x float> poison, float %580, i64 0
  %582 = shufflevector <16 x float> %581, <16 x float> poison, <16 x i32> zeroinitializer
  %583 = fneg contract <16 x float> %582
  %584 = select <16 x i1> %579, <16 x float> %583, <16 x float> %582
  %585 = fadd contract <16 x float> %584, zeroinitializer
  %586 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %578
  %587 = fcmp contract ogt <16 x float> %586, <float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000>
  %588 = select contract <16 x i1> %587, <16 x float> %586, <16 x float> <float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000>
  %589 = fdiv contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %588
  %590 = icmp slt i64 %112, 1
  br i1 %590, label %612, label %591

591:
  %592 = load ptr, ptr %42, align 8
  br label %617

593:
  %594 = phi <16 x float> [ %609, %607 ], [ zeroinitializer, %503 ]
  %595 = phi i64 [ %610, %607 ], [ 0, %503 ]
  %596 = phi <16 x float> [ %608, %607 ], [ zeroinitializer, %503 ]
  %597 = getelementptr inbounds %struct.Joint, ptr %295, i64 %595, i32 2
  %598 = load float, ptr %597, align 4
  %599 = fcmp contract oeq float %598, 0.000000e+00
  br i1 %599, label %600, label %607

600:
  %601 = getelementptr inbounds [16 x <16 x float>], ptr %17, i64 0, i64 %595
  %602 = load <16 x float>, ptr %601, align 64
  %603 = fadd contract <16 x float> %594, %602
  %604 = getelementptr inbounds [16 x <16 x float>], ptr %18, i64 0, i64 %595
  %605 = load <16 x float>, ptr %604, align 64
  %606 = fadd contract <16 x float> %596, %605
  br label %607

607:
  %608 = phi <16 x float> [ %606, %600 ], [ %596, %593 ]
  %609 = phi <16 x float> [ %603, %600 ], [ %594, %593 ]
  %610 = add nuw nsw i64 %595, 1
  %611 = icmp eq i64 %610, %112
  br i1 %611, label %576, label %593

612:
  %613 = load i64, ptr %43, align 8
  %614 = icmp sgt i64 %613, 0
  br i1 %614, label %615, label %739

615:
  %616 = load ptr, ptr %44, align 8
  br label %740

617:
  %618 = phi i64 [ 1, %591 ], [ %684, %679 ]
  %619 = getelementptr inbounds %struct.Sphere, ptr %592, i64 %618
  %620 = getelementptr inbounds [17 x %struct.Frame], ptr %27, i64 0, i64 %618
  %621 = load float, ptr %619, align 4
  %622 = getelementptr inbounds i8, ptr %619, i64 4
  %623 = load float, ptr %622, align 4
  %624 = getelementptr inbounds i8, ptr %619, i64 8
  %625 = load float, ptr %624, align 4
  %626 = getelementptr inbounds i8, ptr %620, i64 576
  %627 = load <16 x float>, ptr %626, align 64
  %628 = load <16 x float>, ptr %620, align 64
  %629 = insertelement <16 x float> poison, float %621, i64 0
  %630 = shufflevector <16 x float> %629, <16 x float> poison, <16 x i32> zeroinitializer
  %631 = fmul contract <16 x float> %630, %628
  %632 = fadd contract <16 x float> %627, %631
  %633 = getelementptr inbounds i8, ptr %620, i64 64
  %634 = load <16 x float>, ptr %633, align 64
  %635 = insertelement <16 x float> poison, float %623, i64 0
  %636 = shufflevector <16 x float> %635, <16 x float> poison, <16 x i32> zeroinitializer
  %637 = fmul contract <16 x float> %636, %634
  %638 = fadd contract <16 x float> %632, %637
  %639 = getelementptr inbounds i8, ptr %620, i64 128
  %640 = load <16 x float>, ptr %639, align 64
  %641 = insertelement <16 x float> poison, float %625, i64 0
  %642 = shufflevector <16 x float> %641, <16 x float> poison, <16 x i32> zeroinitializer
  %643 = fmul contract <16 x float> %642, %640
  %644 = fadd contract <16 x float> %638, %643
  %645 = getelementptr inbounds i8, ptr %620, i64 640
  %646 = load <16 x float>, ptr %645, align 64
  %647 = getelementptr inbounds i8, ptr %620, i64 192
  %648 = load <16 x float>, ptr %647, align 64
  %649 = fmul contract <16 x float> %630, %648
  %650 = fadd contract <16 x float> %646, %649
  %651 = getelementptr inbounds i8, ptr %620, i64 256
  %652 = load <16 x float>, ptr %651, align 64
  %653 = fmul contract <16 x float> %636, %652
  %654 = fadd contract <16 x float> %650, %653
  %655 = getelementptr inbounds i8, ptr %620, i64 320
  %656 = load <16 x float>, ptr %655, align 64
  %657 = fmul contract <16 x float> %642, %656
  %658 = fadd contract <16 x float> %654, %657
  %659 = getelementptr inbounds i8, ptr %620, i64 704
  %660 = load <16 x float>, ptr %659, align 64
  %661 = getelementptr inbounds i8, ptr %620, i64 384
  %662 = load <16 x float>, ptr %661, align 64
  %663 = fmul contract <16 x float> %630, %662
  %664 = fadd contract <16 x float> %660, %663
  %665 = getelementptr inbounds i8, ptr %620, i64 448
  %666 = load <16 x float>, ptr %665, align 64
  %667 = fmul contract <16 x float> %636, %666
  %668 = fadd contract <16 x float> %664, %667
  %669 = getelementptr inbounds i8, ptr %620, i64 512
  %670 = load <16 x float>, ptr %669, align 64
  %671 = fmul contract <16 x float> %642, %670
  %672 = fadd contract <16 x float> %668, %671
  %673 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %29, i64 0, i64 %618, i64 %618
  store <16 x float> zeroinitializer, ptr %673, align 64
  %674 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %618, i64 %618
  store <16 x float> zeroinitializer, ptr %674, align 64
  %675 = getelementptr inbounds i8, ptr %619, i64 12
  %676 = load float, ptr %675, align 4
  %677 = insertelement <16 x float> poison, float %676, i64 0
  %678 = shufflevector <16 x float> %677, <16 x float> poison, <16 x i32> zeroinitializer
  br label %686

679:
  %680 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %618
  %681 = load <16 x float>, ptr %680, align 64
  %682 = fadd contract <16 x float> %585, %681
  %683 = getelementptr inbounds [17 x <16 x float>], ptr %19, i64 0, i64 %618
  store <16 x float> %682, ptr %683, align 64
  %684 = add nuw i64 %618, 1
  %685 = icmp eq i64 %618, %112
  br i1 %685, label %612, label %617

686:
  %687 = phi <16 x float> [ zeroinitializer, %617 ], [ %736, %686 ]
  %688 = phi <16 x float> [ zeroinitializer, %617 ], [ %731, %686 ]
  %689 = phi i64 [ %618, %617 ], [ %690, %686 ]
  %690 = add nsw i64 %689, -1
  %691 = getelementptr inbounds [17 x %struct.Frame], ptr %27, i64 0, i64 %689
  %692 = getelementptr inbounds i8, ptr %691, i64 576
  %693 = load <16 x float>, ptr %692, align 64
  %694 = fsub contract <16 x float> %644, %693
  %695 = getelementptr inbounds i8, ptr %691, i64 640
  %696 = load <16 x float>, ptr %695, align 64
  %697 = fsub contract <16 x float> %658, %696
  %698 = getelementptr inbounds i8, ptr %691, i64 704
  %699 = load <16 x float>, ptr %698, align 64
  %700 = fsub contract <16 x float> %672, %699
  %701 = getelementptr inbounds i8, ptr %691, i64 128
  %702 = load <16 x float>, ptr %701, align 64
  %703 = fmul contract <16 x float> %694, %702
  %704 = getelementptr inbounds i8, ptr %691, i64 320
  %705 = load <16 x float>, ptr %704, align 64
  %706 = fmul contract <16 x float> %697, %705
  %707 = fadd contract <16 x float> %703, %706
  %708 = getelementptr inbounds i8, ptr %691, i64 512
  %709 = load <16 x float>, ptr %708, align 64
  %710 = fmul contract <16 x float> %700, %709
  %711 = fadd contract <16 x float> %707, %710
  %712 = fmul contract <16 x float> %694, %694
  %713 = fmul contract <16 x float> %697, %697
  %714 = fadd contract <16 x float> %712, %713
  %715 = fmul contract <16 x float> %700, %700
  %716 = fadd contract <16 x float> %714, %715
  %717 = fmul contract <16 x float> %711, %711
  %718 = fsub contract <16 x float> %716, %717
  %719 = fcmp contract ogt <16 x float> %718, zeroinitializer
  %720 = select contract <16 x i1> %719, <16 x float> %718, <16 x float> zeroinitializer
  %721 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %720)
  %722 = fadd contract <16 x float> %678, %721
  %723 = getelementptr inbounds %struct.Joint, ptr %295, i64 %690, i32 2
  %724 = load float, ptr %723, align 4
  %725 = fcmp contract une float %724, 0.000000e+00
  %726 = select i1 %725, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> %722
  %727 = getelementptr inbounds [16 x <16 x float>], ptr %17, i64 0, i64 %690
  %728 = load <16 x float>, ptr %727, align 64
  %729 = fmul contract <16 x float> %589, %728
  %730 = fmul contract <16 x float> %729, %726
  %731 = fadd contract <16 x float> %688, %730
  %732 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %618, i64 %690
  store <16 x float> %731, ptr %732, align 64
  %733 = getelementptr inbounds [16 x <16 x float>], ptr %18, i64 0, i64 %690
  %734 = load <16 x float>, ptr %733, align 64
  %735 = fmul contract <16 x float> %734, %726
  %736 = fadd contract <16 x float> %687, %735
  %737 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %29, i64 0, i64 %618, i64 %690
  store <16 x float> %736, ptr %737, align 64
  %738 = icmp sgt i64 %689, 1
  br i1 %738, label %686, label %679

739:
  br i1 %590, label %754, label %759

740:
  %741 = phi i64 [ 0, %615 ], [ %750, %740 ]
  %742 = getelementptr inbounds %struct.LinkPair, ptr %616, i64 %741
  %743 = getelementptr inbounds i8, ptr %742, i64 8
  %744 = load i64, ptr %743, align 8
  %745 = load i64, ptr %742, align 8
  %746 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %744, i64 %745
  %747 = load <16 x float>, ptr %746, align 64
  %748 = fadd contract <16 x float> %585, %747
  %749 = getelementptr inbounds [136 x <16 x float>], ptr %20, i64 0, i64 %741
  store <16 x float> %748, ptr %749, align 64
  %750 = add nuw nsw i64 %741, 1
  %751 = icmp eq i64 %750, %613
  br i1 %751, label %739, label %740

752:
  %753 = load i64, ptr %43, align 8
  br label %754

754:
  %755 = phi i64 [ %613, %739 ], [ %753, %752 ]
  %756 = phi i64 [ %64, %739 ], [ %1169, %752 ]
  %757 = phi <16 x i32> [ zeroinitializer, %739 ], [ %1170, %752 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %13)
  %758 = icmp sgt i64 %755, 0
  br i1 %758, label %1173, label %1762

759:
  %760 = phi i64 [ %1168, %1167 ], [ %112, %739 ]
  %761 = phi <16 x i32> [ %1170, %1167 ], [ zeroinitializer, %739 ]
  %762 = phi i64 [ %1171, %1167 ], [ 1, %739 ]
  %763 = phi i64 [ %1169, %1167 ], [ %64, %739 ]
  %764 = load ptr, ptr %45, align 8
  %765 = getelementptr inbounds %struct.Sphere, ptr %764, i64 %762
  %766 = getelementptr inbounds i8, ptr %765, i64 12
  %767 = load float, ptr %766, align 4
  %768 = fcmp contract olt float %767, 0.000000e+00
  br i1 %768, label %1167, label %769

769:
  %770 = getelementptr inbounds %struct.Frame, ptr %27, i64 %762
  %771 = load float, ptr %765, align 4
  %772 = getelementptr inbounds i8, ptr %765, i64 4
  %773 = load float, ptr %772, align 4
  %774 = getelementptr inbounds i8, ptr %765, i64 8
  %775 = load float, ptr %774, align 4
  %776 = getelementptr inbounds i8, ptr %770, i64 576
  %777 = load <16 x float>, ptr %776, align 64
  %778 = load <16 x float>, ptr %770, align 64
  %779 = insertelement <16 x float> poison, float %771, i64 0
  %780 = shufflevector <16 x float> %779, <16 x float> poison, <16 x i32> zeroinitializer
  %781 = fmul contract <16 x float> %780, %778
  %782 = fadd contract <16 x float> %777, %781
  %783 = getelementptr inbounds i8, ptr %770, i64 64
  %784 = load <16 x float>, ptr %783, align 64
  %785 = insertelement <16 x float> poison, float %773, i64 0
  %786 = shufflevector <16 x float> %785, <16 x float> poison, <16 x i32> zeroinitializer
  %787 = fmul contract <16 x float> %786, %784
  %788 = fadd contract <16 x float> %782, %787
  %789 = getelementptr inbounds i8, ptr %770, i64 128
  %790 = load <16 x float>, ptr %789, align 64
  %791 = insertelement <16 x float> poison, float %775, i64 0
  %792 = shufflevector <16 x float> %791, <16 x float> poison, <16 x i32> zeroinitializer
  %793 = fmul contract <16 x float> %792, %790
  %794 = fadd contract <16 x float> %788, %793
  %795 = getelementptr inbounds i8, ptr %770, i64 640
  %796 = load <16 x float>, ptr %795, align 64
  %797 = getelementptr inbounds i8, ptr %770, i64 192
  %798 = load <16 x float>, ptr %797, align 64
  %799 = fmul contract <16 x float> %780, %798
  %800 = fadd contract <16 x float> %796, %799
  %801 = getelementptr inbounds i8, ptr %770, i64 256
  %802 = load <16 x float>, ptr %801, align 64
  %803 = fmul contract <16 x float> %786, %802
  %804 = fadd contract <16 x float> %800, %803
  %805 = getelementptr inbounds i8, ptr %770, i64 320
  %806 = load <16 x float>, ptr %805, align 64
  %807 = fmul contract <16 x float> %792, %806
  %808 = fadd contract <16 x float> %804, %807
  %809 = getelementptr inbounds i8, ptr %770, i64 704
  %810 = load <16 x float>, ptr %809, align 64
  %811 = getelementptr inbounds i8, ptr %770, i64 384
  %812 = load <16 x float>, ptr %811, align 64
  %813 = fmul contract <16 x float> %780, %812
  %814 = fadd contract <16 x float> %810, %813
  %815 = getelementptr inbounds i8, ptr %770, i64 448
  %816 = load <16 x float>, ptr %815, align 64
  %817 = fmul contract <16 x float> %786, %816
  %818 = fadd contract <16 x float> %814, %817
  %819 = getelementptr inbounds i8, ptr %770, i64 512
  %820 = load <16 x float>, ptr %819, align 64
  %821 = fmul contract <16 x float> %792, %820
  %822 = fadd contract <16 x float> %818, %821
  %823 = getelementptr inbounds <16 x float>, ptr %19, i64 %762
  %824 = load <16 x float>, ptr %823, align 64
  %825 = load i64, ptr %46, align 8
  %826 = icmp sgt i64 %825, 0
  br i1 %826, label %827, label %1167

827:
  %828 = add nsw i64 %762, -1
  %829 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %29, i64 0, i64 %762, i64 0
  %830 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %762, i64 0
  br label %831

831:
  %832 = phi i64 [ %825, %827 ], [ %1160, %1159 ]
  %833 = phi <16 x i32> [ %761, %827 ], [ %1162, %1159 ]
  %834 = phi i64 [ 0, %827 ], [ %1163, %1159 ]
  %835 = phi i64 [ %763, %827 ], [ %1161, %1159 ]
  %836 = load ptr, ptr %47, align 8
  %837 = getelementptr inbounds %struct.Object, ptr %836, i64 %834
  %838 = load ptr, ptr %48, align 8
  %839 = mul nsw i64 %832, %762
  %840 = getelementptr float, ptr %838, i64 %839
  %841 = getelementptr float, ptr %840, i64 %834
  %842 = load float, ptr %841, align 4
  %843 = getelementptr inbounds i8, ptr %837, i64 60
  %844 = load float, ptr %843, align 4
  %845 = fadd contract float %842, %844
  %846 = fcmp contract olt float %845, -1.000000e+08
  br i1 %846, label %1159, label %847

847:
  %848 = load float, ptr %766, align 4
  %849 = fadd contract float %845, %848
  %850 = insertelement <16 x float> poison, float %849, i64 0
  %851 = shufflevector <16 x float> %850, <16 x float> poison, <16 x i32> zeroinitializer
  %852 = fadd contract <16 x float> %824, %851
  %853 = fcmp contract ogt <16 x float> %852, zeroinitializer
  %854 = select contract <16 x i1> %853, <16 x float> %852, <16 x float> zeroinitializer
  %855 = getelementptr inbounds i8, ptr %837, i64 36
  %856 = load float, ptr %855, align 4
  %857 = insertelement <16 x float> poison, float %856, i64 0
  %858 = shufflevector <16 x float> %857, <16 x float> poison, <16 x i32> zeroinitializer
  %859 = load float, ptr %837, align 4
  %860 = insertelement <16 x float> poison, float %859, i64 0
  %861 = shufflevector <16 x float> %860, <16 x float> poison, <16 x i32> zeroinitializer
  %862 = fmul contract <16 x float> %794, %861
  %863 = fadd contract <16 x float> %858, %862
  %864 = getelementptr inbounds i8, ptr %837, i64 4
  %865 = load float, ptr %864, align 4
  %866 = insertelement <16 x float> poison, float %865, i64 0
  %867 = shufflevector <16 x float> %866, <16 x float> poison, <16 x i32> zeroinitializer
  %868 = fmul contract <16 x float> %808, %867
  %869 = fadd contract <16 x float> %863, %868
  %870 = getelementptr inbounds i8, ptr %837, i64 8
  %871 = load float, ptr %870, align 4
  %872 = insertelement <16 x float> poison, float %871, i64 0
  %873 = shufflevector <16 x float> %872, <16 x float> poison, <16 x i32> zeroinitializer
  %874 = fmul contract <16 x float> %822, %873
  %875 = fadd contract <16 x float> %869, %874
  %876 = getelementptr inbounds i8, ptr %837, i64 40
  %877 = load float, ptr %876, align 4
  %878 = insertelement <16 x float> poison, float %877, i64 0
  %879 = shufflevector <16 x float> %878, <16 x float> poison, <16 x i32> zeroinitializer
  %880 = getelementptr inbounds i8, ptr %837, i64 12
  %881 = load float, ptr %880, align 4
  %882 = insertelement <16 x float> poison, float %881, i64 0
  %883 = shufflevector <16 x float> %882, <16 x float> poison, <16 x i32> zeroinitializer
  %884 = fmul contract <16 x float> %794, %883
  %885 = fadd contract <16 x float> %879, %884
  %886 = getelementptr inbounds i8, ptr %837, i64 16
  %887 = load float, ptr %886, align 4
  %888 = insertelement <16 x float> poison, float %887, i64 0
  %889 = shufflevector <16 x float> %888, <16 x float> poison, <16 x i32> zeroinitializer
  %890 = fmul contract <16 x float> %808, %889
  %891 = fadd contract <16 x float> %885, %890
  %892 = getelementptr inbounds i8, ptr %837, i64 20
  %893 = load float, ptr %892, align 4
  %894 = insertelement <16 x float> poison, float %893, i64 0
  %895 = shufflevector <16 x float> %894, <16 x float> poison, <16 x i32> zeroinitializer
  %896 = fmul contract <16 x float> %822, %895
  %897 = fadd contract <16 x float> %891, %896
  %898 = getelementptr inbounds i8, ptr %837, i64 44
  %899 = load float, ptr %898, align 4
  %900 = insertelement <16 x float> poison, float %899, i64 0
  %901 = shufflevector <16 x float> %900, <16 x float> poison, <16 x i32> zeroinitializer
  %902 = getelementptr inbounds i8, ptr %837, i64 24
  %903 = load float, ptr %902, align 4
  %904 = insertelement <16 x float> poison, float %903, i64 0
  %905 = shufflevector <16 x float> %904, <16 x float> poison, <16 x i32> zeroinitializer
  %906 = fmul contract <16 x float> %794, %905
  %907 = fadd contract <16 x float> %901, %906
  %908 = getelementptr inbounds i8, ptr %837, i64 28
  %909 = load float, ptr %908, align 4
  %910 = insertelement <16 x float> poison, float %909, i64 0
  %911 = shufflevector <16 x float> %910, <16 x float> poison, <16 x i32> zeroinitializer
  %912 = fmul contract <16 x float> %808, %911
  %913 = fadd contract <16 x float> %907, %912
  %914 = getelementptr inbounds i8, ptr %837, i64 32
  %915 = load float, ptr %914, align 4
  %916 = insertelement <16 x float> poison, float %915, i64 0
  %917 = shufflevector <16 x float> %916, <16 x float> poison, <16 x i32> zeroinitializer
  %918 = fmul contract <16 x float> %822, %917
  %919 = fadd contract <16 x float> %913, %918
  %920 = fmul contract <16 x float> %875, zeroinitializer
  %921 = getelementptr inbounds i8, ptr %837, i64 68
  %922 = load float, ptr %921, align 4
  %923 = fcmp contract une float %922, 0.000000e+00
  %924 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %919)
  %925 = select contract i1 %923, <16 x float> %919, <16 x float> %924
  %926 = getelementptr inbounds i8, ptr %837, i64 64
  %927 = load float, ptr %926, align 4
  %928 = fcmp contract une float %927, 0.000000e+00
  br i1 %928, label %929, label %934

929:
  %930 = fmul contract <16 x float> %875, %875
  %931 = fmul contract <16 x float> %897, %897
  %932 = fadd contract <16 x float> %930, %931
  %933 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %932)
  br label %936

934:
  %935 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %875)
  br label %936

936:
  %937 = phi contract <16 x float> [ %933, %929 ], [ %935, %934 ]
  %938 = getelementptr inbounds i8, ptr %837, i64 48
  %939 = load float, ptr %938, align 4
  %940 = insertelement <16 x float> poison, float %939, i64 0
  %941 = shufflevector <16 x float> %940, <16 x float> poison, <16 x i32> zeroinitializer
  %942 = fsub contract <16 x float> %937, %941
  %943 = fcmp contract ogt <16 x float> %942, %920
  %944 = select contract <16 x i1> %943, <16 x float> %942, <16 x float> %920
  %945 = getelementptr inbounds i8, ptr %837, i64 56
  %946 = load float, ptr %945, align 4
  %947 = insertelement <16 x float> poison, float %946, i64 0
  %948 = shufflevector <16 x float> %947, <16 x float> poison, <16 x i32> zeroinitializer
  %949 = fsub contract <16 x float> %925, %948
  %950 = fcmp contract ogt <16 x float> %949, %920
  %951 = select contract <16 x i1> %950, <16 x float> %949, <16 x float> %920
  %952 = fmul contract <16 x float> %944, %944
  %953 = fmul contract <16 x float> %951, %951
  %954 = fadd contract <16 x float> %952, %953
  br i1 %928, label %966, label %955

955:
  %956 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %897)
  %957 = getelementptr inbounds i8, ptr %837, i64 52
  %958 = load float, ptr %957, align 4
  %959 = insertelement <16 x float> poison, float %958, i64 0
  %960 = shufflevector <16 x float> %959, <16 x float> poison, <16 x i32> zeroinitializer
  %961 = fsub contract <16 x float> %956, %960
  %962 = fcmp contract ogt <16 x float> %961, %920
  %963 = select contract <16 x i1> %962, <16 x float> %961, <16 x float> %920
  %964 = fmul contract <16 x float> %963, %963
  %965 = fadd contract <16 x float> %954, %964
  br label %966

966:
  %967 = phi <16 x float> [ %965, %955 ], [ %954, %936 ]
  %968 = fmul contract <16 x float> %854, %854
  %969 = fcmp contract olt <16 x float> %967, %968
  %970 = bitcast <16 x i1> %969 to i16
  %971 = icmp eq i16 %970, 0
  br i1 %971, label %1159, label %972

972:
  %973 = load ptr, ptr %49, align 8
  %974 = getelementptr inbounds i64, ptr %973, i64 %762
  %975 = load i64, ptr %974, align 8
  %976 = getelementptr inbounds i8, ptr %974, i64 8
  %977 = load i64, ptr %976, align 8
  %978 = icmp slt i64 %975, %977
  br i1 %978, label %979, label %982

979:
  %980 = load ptr, ptr %50, align 8
  %981 = getelementptr inbounds i8, ptr %837, i64 52
  br label %1060

982:
  %983 = phi <16 x i32> [ zeroinitializer, %972 ], [ %1154, %1150 ]
  %984 = or <16 x i32> %983, %833
  %985 = mul nsw i64 %832, %828
  %986 = add nsw i64 %985, %834
  %987 = icmp ne <16 x i32> %983, zeroinitializer
  %988 = bitcast <16 x i1> %987 to i16
  %989 = zext i16 %988 to i64
  %990 = and i64 %181, %989
  %991 = icmp eq i64 %990, 0
  br i1 %991, label %1159, label %992

992:
  %993 = load <16 x float>, ptr %829, align 64
  %994 = load <16 x float>, ptr %830, align 64
  %995 = and i64 %990, %111
  %996 = icmp eq i64 %995, 0
  br i1 %996, label %1159, label %997

997:
  %998 = phi i64 [ %1056, %1055 ], [ %835, %992 ]
  %999 = phi i64 [ %1058, %1055 ], [ %995, %992 ]
  %1000 = tail call range(i64 0, 65) i64 @llvm.cttz.i64(i64 %999, i1 true)
  %1001 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %1000
  %1002 = getelementptr inbounds i8, ptr %1001, i64 8
  %1003 = load float, ptr %1002, align 8
  %1004 = getelementptr inbounds i8, ptr %1001, i64 12
  %1005 = load float, ptr %1004, align 4
  %1006 = fcmp contract une float %1003, %1005
  br i1 %1006, label %1007, label %1055

1007:
  %1008 = load i64, ptr %1001, align 16
  %1009 = extractelement <16 x float> %993, i64 %1000
  %1010 = extractelement <16 x float> %994, i64 %1000
  %1011 = extractelement <16 x float> %577, i64 %1000
  %1012 = fmul contract float %1010, %1011
  %1013 = fadd contract float %1009, %1012
  %1014 = fpext float %1013 to double
  %1015 = fmul contract double %1014, 1.001000e+00
  %1016 = icmp sle i64 %998, %4
  %1017 = icmp sgt i64 %998, 0
  %1018 = and i1 %1016, %1017
  br i1 %1018, label %1019, label %1043

1019:
  %1020 = tail call i64 @llvm.umax.i64(i64 %998, i64 64)
  %1021 = add nsw i64 %1020, -63
  br label %1022

1022:
  %1023 = phi i64 [ %1024, %1041 ], [ %998, %1019 ]
  %1024 = add nsw i64 %1023, -1
  %1025 = getelementptr inbounds %struct.Contact, ptr %3, i64 %1024
  %1026 = getelementptr inbounds i8, ptr %1025, i64 16
  %1027 = load i64, ptr %1026, align 8
  %1028 = icmp eq i64 %1027, %986
  br i1 %1028, label %1029, label %1041

1029:
  %1030 = load i64, ptr %1025, align 8
  %1031 = icmp eq i64 %1030, %1008
  br i1 %1031, label %1032, label %1041

1032:
  %1033 = getelementptr inbounds i8, ptr %1025, i64 12
  %1034 = load float, ptr %1033, align 4
  %1035 = fcmp contract une float %1034, %1003
  br i1 %1035, label %1041, label %1036

1036:
  %1037 = getelementptr inbounds i8, ptr %1025, i64 12
  store float %1005, ptr %1037, align 4
  %1038 = getelementptr inbounds i8, ptr %1025, i64 24
  %1039 = load double, ptr %1038, align 8
  %1040 = fcmp contract ogt double %1015, %1039
  br i1 %1040, label %1052, label %1055

1041:
  %1042 = icmp sgt i64 %1023, %1021
  br i1 %1042, label %1022, label %1043

1043:
  %1044 = add i64 %998, 1
  %1045 = icmp slt i64 %998, %4
  br i1 %1045, label %1046, label %1055

1046:
  %1047 = getelementptr inbounds %struct.Contact, ptr %3, i64 %998
  store i64 %1008, ptr %1047, align 8
  %1048 = getelementptr inbounds i8, ptr %1047, i64 8
  store float %1003, ptr %1048, align 8
  %1049 = getelementptr inbounds i8, ptr %1047, i64 12
  store float %1005, ptr %1049, align 4
  %1050 = getelementptr inbounds i8, ptr %1047, i64 16
  store i64 %986, ptr %1050, align 8
  %1051 = getelementptr inbounds i8, ptr %1047, i64 24
  br label %1052

1052:
  %1053 = phi i64 [ %1044, %1046 ], [ %998, %1036 ]
  %1054 = phi ptr [ %1051, %1046 ], [ %1038, %1036 ]
  store double %1015, ptr %1054, align 8
  br label %1055

1055:
  %1056 = phi i64 [ %1053, %1052 ], [ %1044, %1043 ], [ %998, %1036 ], [ %998, %997 ]
  %1057 = add nsw i64 %999, -1
  %1058 = and i64 %1057, %999
  %1059 = icmp eq i64 %1058, 0
  br i1 %1059, label %1157, label %997

1060:
  %1061 = phi <16 x i32> [ zeroinitializer, %979 ], [ %1154, %1150 ]
  %1062 = phi i64 [ %975, %979 ], [ %1155, %1150 ]
  %1063 = getelementptr inbounds %struct.Sphere, ptr %980, i64 %1062
  %1064 = getelementptr inbounds i8, ptr %1063, i64 12
  %1065 = load float, ptr %1064, align 4
  %1066 = fadd contract float %845, %1065
  %1067 = insertelement <16 x float> poison, float %1066, i64 0
  %1068 = shufflevector <16 x float> %1067, <16 x float> poison, <16 x i32> zeroinitializer
  %1069 = fadd contract <16 x float> %824, %1068
  %1070 = fcmp contract ogt <16 x float> %1069, zeroinitializer
  %1071 = select contract <16 x i1> %1070, <16 x float> %1069, <16 x float> zeroinitializer
  %1072 = load float, ptr %1063, align 4
  %1073 = getelementptr inbounds i8, ptr %1063, i64 4
  %1074 = load float, ptr %1073, align 4
  %1075 = getelementptr inbounds i8, ptr %1063, i64 8
  %1076 = load float, ptr %1075, align 4
  %1077 = insertelement <16 x float> poison, float %1072, i64 0
  %1078 = shufflevector <16 x float> %1077, <16 x float> poison, <16 x i32> zeroinitializer
  %1079 = fmul contract <16 x float> %778, %1078
  %1080 = fadd contract <16 x float> %777, %1079
  %1081 = insertelement <16 x float> poison, float %1074, i64 0
  %1082 = shufflevector <16 x float> %1081, <16 x float> poison, <16 x i32> zeroinitializer
  %1083 = fmul contract <16 x float> %784, %1082
  %1084 = fadd contract <16 x float> %1080, %1083
  %1085 = insertelement <16 x float> poison, float %1076, i64 0
  %1086 = shufflevector <16 x float> %1085, <16 x float> poison, <16 x i32> zeroinitializer
  %1087 = fmul contract <16 x float> %790, %1086
  %1088 = fadd contract <16 x float> %1084, %1087
  %1089 = fmul contract <16 x float> %798, %1078
  %1090 = fadd contract <16 x float> %796, %1089
  %1091 = fmul contract <16 x float> %802, %1082
  %1092 = fadd contract <16 x float> %1090, %1091
  %1093 = fmul contract <16 x float> %806, %1086
  %1094 = fadd contract <16 x float> %1092, %1093
  %1095 = fmul contract <16 x float> %812, %1078
  %1096 = fadd contract <16 x float> %810, %1095
  %1097 = fmul contract <16 x float> %816, %1082
  %1098 = fadd contract <16 x float> %1096, %1097
  %1099 = fmul contract <16 x float> %820, %1086
  %1100 = fadd contract <16 x float> %1098, %1099
  %1101 = fmul contract <16 x float> %861, %1088
  %1102 = fadd contract <16 x float> %858, %1101
  %1103 = fmul contract <16 x float> %867, %1094
  %1104 = fadd contract <16 x float> %1103, %1102
  %1105 = fmul contract <16 x float> %873, %1100
  %1106 = fadd contract <16 x float> %1105, %1104
  %1107 = fmul contract <16 x float> %883, %1088
  %1108 = fadd contract <16 x float> %879, %1107
  %1109 = fmul contract <16 x float> %889, %1094
  %1110 = fadd contract <16 x float> %1109, %1108
  %1111 = fmul contract <16 x float> %895, %1100
  %1112 = fadd contract <16 x float> %1111, %1110
  %1113 = fmul contract <16 x float> %905, %1088
  %1114 = fadd contract <16 x float> %901, %1113
  %1115 = fmul contract <16 x float> %911, %1094
  %1116 = fadd contract <16 x float> %1115, %1114
  %1117 = fmul contract <16 x float> %917, %1100
  %1118 = fadd contract <16 x float> %1117, %1116
  %1119 = fmul contract <16 x float> %1106, zeroinitializer
  %1120 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %1118)
  %1121 = select contract i1 %923, <16 x float> %1118, <16 x float> %1120
  br i1 %928, label %1122, label %1127

1122:
  %1123 = fmul contract <16 x float> %1106, %1106
  %1124 = fmul contract <16 x float> %1112, %1112
  %1125 = fadd contract <16 x float> %1123, %1124
  %1126 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %1125)
  br label %1129

1127:
  %1128 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %1106)
  br label %1129

1129:
  %1130 = phi contract <16 x float> [ %1126, %1122 ], [ %1128, %1127 ]
  %1131 = fsub contract <16 x float> %1130, %941
  %1132 = fcmp contract ogt <16 x float> %1131, %1119
  %1133 = select contract <16 x i1> %1132, <16 x float> %1131, <16 x float> %1119
  %1134 = fsub contract <16 x float> %1121, %948
  %1135 = fcmp contract ogt <16 x float> %1134, %1119
  %1136 = select contract <16 x i1> %1135, <16 x float> %1134, <16 x float> %1119
  %1137 = fmul contract <16 x float> %1133, %1133
  %1138 = fmul contract <16 x float> %1136, %1136
  %1139 = fadd contract <16 x float> %1138, %1137
  br i1 %928, label %1150, label %1140

1140:
  %1141 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %1112)
  %1142 = load float, ptr %981, align 4
  %1143 = insertelement <16 x float> poison, float %1142, i64 0
  %1144 = shufflevector <16 x float> %1143, <16 x float> poison, <16 x i32> zeroinitializer
  %1145 = fsub contract <16 x float> %1141, %1144
  %1146 = fcmp contract ogt <16 x float> %1145, %1119
  %1147 = select contract <16 x i1> %1146, <16 x float> %1145, <16 x float> %1119
  %1148 = fmul contract <16 x float> %1147, %1147
  %1149 = fadd contract <16 x float> %1139, %1148
  br label %1150

1150:
  %1151 = phi <16 x float> [ %1149, %1140 ], [ %1139, %1129 ]
  %1152 = fmul contract <16 x float> %1071, %1071
  %1153 = fcmp contract olt <16 x float> %1151, %1152
  %1154 = select <16 x i1> %1153, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %1061
  %1155 = add nsw i64 %1062, 1
  %1156 = icmp eq i64 %1155, %977
  br i1 %1156, label %982, label %1060

1157:
  %1158 = load i64, ptr %46, align 8
  br label %1159

1159:
  %1160 = phi i64 [ %832, %831 ], [ %832, %966 ], [ %832, %982 ], [ %832, %992 ], [ %1158, %1157 ]
  %1161 = phi i64 [ %835, %831 ], [ %835, %966 ], [ %835, %982 ], [ %835, %992 ], [ %1056, %1157 ]
  %1162 = phi <16 x i32> [ %833, %831 ], [ %833, %966 ], [ %984, %982 ], [ %984, %992 ], [ %984, %1157 ]
  %1163 = add nuw nsw i64 %834, 1
  %1164 = icmp slt i64 %1163, %1160
  br i1 %1164, label %831, label %1165

1165:
  %1166 = load i64, ptr %0, align 8
  br label %1167

1167:
  %1168 = phi i64 [ %760, %759 ], [ %760, %769 ], [ %1166, %1165 ]
  %1169 = phi i64 [ %763, %759 ], [ %763, %769 ], [ %1161, %1165 ]
  %1170 = phi <16 x i32> [ %761, %759 ], [ %761, %769 ], [ %1162, %1165 ]
  %1171 = add nuw nsw i64 %762, 1
  %1172 = icmp slt i64 %762, %1168
  br i1 %1172, label %759, label %752

1173:
  %1174 = phi <16 x i32> [ %1758, %1755 ], [ %757, %754 ]
  %1175 = phi i64 [ %1757, %1755 ], [ 0, %754 ]
  %1176 = phi i64 [ %1759, %1755 ], [ 0, %754 ]
  %1177 = phi i64 [ %1756, %1755 ], [ %756, %754 ]
  %1178 = load ptr, ptr %44, align 8
  %1179 = getelementptr inbounds %struct.LinkPair, ptr %1178, i64 %1176
  %1180 = load ptr, ptr %42, align 8
  %1181 = load i64, ptr %1179, align 8
  %1182 = getelementptr inbounds %struct.Sphere, ptr %1180, i64 %1181
  %1183 = getelementptr inbounds i8, ptr %1179, i64 8
  %1184 = load i64, ptr %1183, align 8
  %1185 = getelementptr inbounds %struct.Sphere, ptr %1180, i64 %1184
  %1186 = getelementptr inbounds %struct.Frame, ptr %27, i64 %1181
  %1187 = getelementptr inbounds %struct.Frame, ptr %27, i64 %1184
  %1188 = getelementptr inbounds <16 x float>, ptr %20, i64 %1176
  %1189 = load <16 x float>, ptr %1188, align 64
  %1190 = load ptr, ptr %51, align 8
  %1191 = getelementptr inbounds float, ptr %1190, i64 %1176
  %1192 = load float, ptr %1191, align 4
  %1193 = insertelement <16 x float> poison, float %1192, i64 0
  %1194 = shufflevector <16 x float> %1193, <16 x float> poison, <16 x i32> zeroinitializer
  %1195 = fadd contract <16 x float> %1189, %1194
  %1196 = load float, ptr %1185, align 4
  %1197 = getelementptr inbounds i8, ptr %1185, i64 4
  %1198 = load float, ptr %1197, align 4
  %1199 = getelementptr inbounds i8, ptr %1185, i64 8
  %1200 = load float, ptr %1199, align 4
  %1201 = getelementptr inbounds i8, ptr %1187, i64 576
  %1202 = load <16 x float>, ptr %1201, align 64
  %1203 = load <16 x float>, ptr %1187, align 64
  %1204 = insertelement <16 x float> poison, float %1196, i64 0
  %1205 = shufflevector <16 x float> %1204, <16 x float> poison, <16 x i32> zeroinitializer
  %1206 = fmul contract <16 x float> %1205, %1203
  %1207 = fadd contract <16 x float> %1202, %1206
  %1208 = getelementptr inbounds i8, ptr %1187, i64 64
  %1209 = load <16 x float>, ptr %1208, align 64
  %1210 = insertelement <16 x float> poison, float %1198, i64 0
  %1211 = shufflevector <16 x float> %1210, <16 x float> poison, <16 x i32> zeroinitializer
  %1212 = fmul contract <16 x float> %1211, %1209
  %1213 = fadd contract <16 x float> %1207, %1212
  %1214 = getelementptr inbounds i8, ptr %1187, i64 128
  %1215 = load <16 x float>, ptr %1214, align 64
  %1216 = insertelement <16 x float> poison, float %1200, i64 0
  %1217 = shufflevector <16 x float> %1216, <16 x float> poison, <16 x i32> zeroinitializer
  %1218 = fmul contract <16 x float> %1217, %1215
  %1219 = fadd contract <16 x float> %1213, %1218
  %1220 = getelementptr inbounds i8, ptr %1187, i64 640
  %1221 = load <16 x float>, ptr %1220, align 64
  %1222 = getelementptr inbounds i8, ptr %1187, i64 192
  %1223 = load <16 x float>, ptr %1222, align 64
  %1224 = fmul contract <16 x float> %1205, %1223
  %1225 = fadd contract <16 x float> %1221, %1224
  %1226 = getelementptr inbounds i8, ptr %1187, i64 256
  %1227 = load <16 x float>, ptr %1226, align 64
  %1228 = fmul contract <16 x float> %1211, %1227
  %1229 = fadd contract <16 x float> %1225, %1228
  %1230 = getelementptr inbounds i8, ptr %1187, i64 320
  %1231 = load <16 x float>, ptr %1230, align 64
  %1232 = fmul contract <16 x float> %1217, %1231
  %1233 = fadd contract <16 x float> %1229, %1232
  %1234 = getelementptr inbounds i8, ptr %1187, i64 704
  %1235 = load <16 x float>, ptr %1234, align 64
  %1236 = getelementptr inbounds i8, ptr %1187, i64 384
  %1237 = load <16 x float>, ptr %1236, align 64
  %1238 = fmul contract <16 x float> %1205, %1237
  %1239 = fadd contract <16 x float> %1235, %1238
  %1240 = getelementptr inbounds i8, ptr %1187, i64 448
  %1241 = load <16 x float>, ptr %1240, align 64
  %1242 = fmul contract <16 x float> %1211, %1241
  %1243 = fadd contract <16 x float> %1239, %1242
  %1244 = getelementptr inbounds i8, ptr %1187, i64 512
  %1245 = load <16 x float>, ptr %1244, align 64
  %1246 = fmul contract <16 x float> %1217, %1245
  %1247 = fadd contract <16 x float> %1243, %1246
  %1248 = getelementptr inbounds i8, ptr %1182, i64 12
  %1249 = load float, ptr %1248, align 4
  %1250 = getelementptr inbounds i8, ptr %1185, i64 12
  %1251 = load float, ptr %1250, align 4
  %1252 = fadd contract float %1249, %1251
  %1253 = insertelement <16 x float> poison, float %1252, i64 0
  %1254 = shufflevector <16 x float> %1253, <16 x float> poison, <16 x i32> zeroinitializer
  %1255 = fadd contract <16 x float> %1195, %1254
  %1256 = fcmp contract ogt <16 x float> %1255, zeroinitializer
  %1257 = select contract <16 x i1> %1256, <16 x float> %1255, <16 x float> zeroinitializer
  %1258 = load float, ptr %1182, align 4
  %1259 = getelementptr inbounds i8, ptr %1182, i64 4
  %1260 = load float, ptr %1259, align 4
  %1261 = getelementptr inbounds i8, ptr %1182, i64 8
  %1262 = load float, ptr %1261, align 4
  %1263 = getelementptr inbounds i8, ptr %1186, i64 576
  %1264 = load <16 x float>, ptr %1263, align 64
  %1265 = load <16 x float>, ptr %1186, align 64
  %1266 = insertelement <16 x float> poison, float %1258, i64 0
  %1267 = shufflevector <16 x float> %1266, <16 x float> poison, <16 x i32> zeroinitializer
  %1268 = fmul contract <16 x float> %1267, %1265
  %1269 = fadd contract <16 x float> %1264, %1268
  %1270 = getelementptr inbounds i8, ptr %1186, i64 64
  %1271 = load <16 x float>, ptr %1270, align 64
  %1272 = insertelement <16 x float> poison, float %1260, i64 0
  %1273 = shufflevector <16 x float> %1272, <16 x float> poison, <16 x i32> zeroinitializer
  %1274 = fmul contract <16 x float> %1273, %1271
  %1275 = fadd contract <16 x float> %1269, %1274
  %1276 = getelementptr inbounds i8, ptr %1186, i64 128
  %1277 = load <16 x float>, ptr %1276, align 64
  %1278 = insertelement <16 x float> poison, float %1262, i64 0
  %1279 = shufflevector <16 x float> %1278, <16 x float> poison, <16 x i32> zeroinitializer
  %1280 = fmul contract <16 x float> %1279, %1277
  %1281 = fadd contract <16 x float> %1275, %1280
  %1282 = getelementptr inbounds i8, ptr %1186, i64 640
  %1283 = load <16 x float>, ptr %1282, align 64
  %1284 = getelementptr inbounds i8, ptr %1186, i64 192
  %1285 = load <16 x float>, ptr %1284, align 64
  %1286 = fmul contract <16 x float> %1267, %1285
  %1287 = fadd contract <16 x float> %1283, %1286
  %1288 = getelementptr inbounds i8, ptr %1186, i64 256
  %1289 = load <16 x float>, ptr %1288, align 64
  %1290 = fmul contract <16 x float> %1273, %1289
  %1291 = fadd contract <16 x float> %1287, %1290
  %1292 = getelementptr inbounds i8, ptr %1186, i64 320
  %1293 = load <16 x float>, ptr %1292, align 64
  %1294 = fmul contract <16 x float> %1279, %1293
  %1295 = fadd contract <16 x float> %1291, %1294
  %1296 = getelementptr inbounds i8, ptr %1186, i64 704
  %1297 = load <16 x float>, ptr %1296, align 64
  %1298 = getelementptr inbounds i8, ptr %1186, i64 384
  %1299 = load <16 x float>, ptr %1298, align 64
  %1300 = fmul contract <16 x float> %1267, %1299
  %1301 = fadd contract <16 x float> %1297, %1300
  %1302 = getelementptr inbounds i8, ptr %1186, i64 448
  %1303 = load <16 x float>, ptr %1302, align 64
  %1304 = fmul contract <16 x float> %1273, %1303
  %1305 = fadd contract <16 x float> %1301, %1304
  %1306 = getelementptr inbounds i8, ptr %1186, i64 512
  %1307 = load <16 x float>, ptr %1306, align 64
  %1308 = fmul contract <16 x float> %1279, %1307
  %1309 = fadd contract <16 x float> %1305, %1308
  %1310 = fsub contract <16 x float> %1281, %1219
  %1311 = fsub contract <16 x float> %1295, %1233
  %1312 = fsub contract <16 x float> %1309, %1247
  %1313 = fmul contract <16 x float> %1310, %1310
  %1314 = fmul contract <16 x float> %1311, %1311
  %1315 = fadd contract <16 x float> %1313, %1314
  %1316 = fmul contract <16 x float> %1312, %1312
  %1317 = fadd contract <16 x float> %1315, %1316
  %1318 = fmul contract <16 x float> %1257, %1257
  %1319 = fcmp contract olt <16 x float> %1317, %1318
  %1320 = bitcast <16 x i1> %1319 to i16
  %1321 = icmp eq i16 %1320, 0
  br i1 %1321, label %1755, label %1322

1322:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %14)
  store i64 %1181, ptr %14, align 16
  store i64 %1184, ptr %52, align 8
  br label %1329

1323:
  %1324 = getelementptr inbounds i8, ptr %1179, i64 16
  %1325 = load i64, ptr %1324, align 8
  %1326 = getelementptr inbounds i8, ptr %1179, i64 24
  %1327 = load i64, ptr %1326, align 8
  %1328 = icmp slt i64 %1325, %1327
  br i1 %1328, label %1415, label %1412

1329:
  %1330 = phi i64 [ %1175, %1322 ], [ %1409, %1408 ]
  %1331 = phi i64 [ 0, %1322 ], [ %1410, %1408 ]
  %1332 = getelementptr inbounds i8, ptr %14, i64 %1331
  %1333 = load i64, ptr %1332, align 8
  %1334 = shl nuw i64 1, %1333
  %1335 = and i64 %1334, %1330
  %1336 = icmp eq i64 %1335, 0
  br i1 %1336, label %1337, label %1408

1337:
  %1338 = or i64 %1334, %1330
  %1339 = load ptr, ptr %53, align 8
  %1340 = getelementptr inbounds i64, ptr %1339, i64 %1333
  %1341 = load i64, ptr %1340, align 8
  %1342 = getelementptr i8, ptr %1340, i64 8
  %1343 = load i64, ptr %1342, align 8
  %1344 = icmp slt i64 %1341, %1343
  br i1 %1344, label %1345, label %1408

1345:
  %1346 = load ptr, ptr %54, align 8
  %1347 = getelementptr inbounds %struct.Frame, ptr %27, i64 %1333
  %1348 = getelementptr inbounds i8, ptr %1347, i64 576
  %1349 = load <16 x float>, ptr %1348, align 64
  %1350 = load <16 x float>, ptr %1347, align 64
  %1351 = getelementptr inbounds i8, ptr %1347, i64 64
  %1352 = load <16 x float>, ptr %1351, align 64
  %1353 = getelementptr inbounds i8, ptr %1347, i64 128
  %1354 = load <16 x float>, ptr %1353, align 64
  %1355 = getelementptr inbounds i8, ptr %1347, i64 640
  %1356 = load <16 x float>, ptr %1355, align 64
  %1357 = getelementptr inbounds i8, ptr %1347, i64 192
  %1358 = load <16 x float>, ptr %1357, align 64
  %1359 = getelementptr inbounds i8, ptr %1347, i64 256
  %1360 = load <16 x float>, ptr %1359, align 64
  %1361 = getelementptr inbounds i8, ptr %1347, i64 320
  %1362 = load <16 x float>, ptr %1361, align 64
  %1363 = getelementptr inbounds i8, ptr %1347, i64 704
  %1364 = load <16 x float>, ptr %1363, align 64
  %1365 = getelementptr inbounds i8, ptr %1347, i64 384
  %1366 = load <16 x float>, ptr %1365, align 64
  %1367 = getelementptr inbounds i8, ptr %1347, i64 448
  %1368 = load <16 x float>, ptr %1367, align 64
  %1369 = getelementptr inbounds i8, ptr %1347, i64 512
  %1370 = load <16 x float>, ptr %1369, align 64
  br label %1371

1371:
  %1372 = phi i64 [ %1341, %1345 ], [ %1406, %1371 ]
  %1373 = getelementptr inbounds %struct.Part, ptr %1346, i64 %1372
  %1374 = load float, ptr %1373, align 4
  %1375 = getelementptr inbounds i8, ptr %1373, i64 4
  %1376 = load float, ptr %1375, align 4
  %1377 = getelementptr inbounds i8, ptr %1373, i64 8
  %1378 = load float, ptr %1377, align 4
  %1379 = insertelement <16 x float> poison, float %1374, i64 0
  %1380 = shufflevector <16 x float> %1379, <16 x float> poison, <16 x i32> zeroinitializer
  %1381 = fmul contract <16 x float> %1380, %1350
  %1382 = fadd contract <16 x float> %1349, %1381
  %1383 = insertelement <16 x float> poison, float %1376, i64 0
  %1384 = shufflevector <16 x float> %1383, <16 x float> poison, <16 x i32> zeroinitializer
  %1385 = fmul contract <16 x float> %1384, %1352
  %1386 = fadd contract <16 x float> %1382, %1385
  %1387 = insertelement <16 x float> poison, float %1378, i64 0
  %1388 = shufflevector <16 x float> %1387, <16 x float> poison, <16 x i32> zeroinitializer
  %1389 = fmul contract <16 x float> %1388, %1354
  %1390 = fadd contract <16 x float> %1386, %1389
  %1391 = fmul contract <16 x float> %1380, %1358
  %1392 = fadd contract <16 x float> %1356, %1391
  %1393 = fmul contract <16 x float> %1384, %1360
  %1394 = fadd contract <16 x float> %1392, %1393
  %1395 = fmul contract <16 x float> %1388, %1362
  %1396 = fadd contract <16 x float> %1394, %1395
  %1397 = fmul contract <16 x float> %1380, %1366
  %1398 = fadd contract <16 x float> %1364, %1397
  %1399 = fmul contract <16 x float> %1384, %1368
  %1400 = fadd contract <16 x float> %1398, %1399
  %1401 = fmul contract <16 x float> %1388, %1370
  %1402 = fadd contract <16 x float> %1400, %1401
  %1403 = getelementptr inbounds [192 x %struct.Point], ptr %13, i64 0, i64 %1372
  store <16 x float> %1390, ptr %1403, align 64
  %1404 = getelementptr inbounds i8, ptr %1403, i64 64
  store <16 x float> %1396, ptr %1404, align 64
  %1405 = getelementptr inbounds i8, ptr %1403, i64 128
  store <16 x float> %1402, ptr %1405, align 64
  %1406 = add nsw i64 %1372, 1
  %1407 = icmp eq i64 %1406, %1343
  br i1 %1407, label %1408, label %1371

1408:
  %1409 = phi i64 [ %1330, %1329 ], [ %1338, %1337 ], [ %1338, %1371 ]
  %1410 = add nuw nsw i64 %1331, 8
  %1411 = icmp eq i64 %1410, 16
  br i1 %1411, label %1323, label %1329

1412:
  %1413 = phi i64 [ %1177, %1323 ], [ %1750, %1747 ]
  %1414 = phi <16 x i32> [ %1174, %1323 ], [ %1751, %1747 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %14)
  br label %1755

1415:
  %1416 = phi <16 x i32> [ %1751, %1747 ], [ %1174, %1323 ]
  %1417 = phi i64 [ %1752, %1747 ], [ %1325, %1323 ]
  %1418 = phi i1 [ %1748, %1747 ], [ false, %1323 ]
  %1419 = phi i64 [ %1749, %1747 ], [ -1, %1323 ]
  %1420 = phi i64 [ %1750, %1747 ], [ %1177, %1323 ]
  %1421 = load ptr, ptr %55, align 8
  %1422 = getelementptr inbounds %struct.PartPair, ptr %1421, i64 %1417
  %1423 = load ptr, ptr %54, align 8
  %1424 = load i64, ptr %1422, align 8
  %1425 = getelementptr inbounds %struct.Part, ptr %1423, i64 %1424
  %1426 = getelementptr inbounds i8, ptr %1422, i64 8
  %1427 = load i64, ptr %1426, align 8
  %1428 = getelementptr inbounds %struct.Part, ptr %1423, i64 %1427
  %1429 = icmp eq i64 %1424, %1419
  br i1 %1429, label %1458, label %1430

1430:
  %1431 = getelementptr inbounds i8, ptr %1425, i64 28
  %1432 = load float, ptr %1431, align 4
  %1433 = load float, ptr %1250, align 4
  %1434 = fadd contract float %1432, %1433
  %1435 = insertelement <16 x float> poison, float %1434, i64 0
  %1436 = shufflevector <16 x float> %1435, <16 x float> poison, <16 x i32> zeroinitializer
  %1437 = fadd contract <16 x float> %1195, %1436
  %1438 = fcmp contract ogt <16 x float> %1437, zeroinitializer
  %1439 = select contract <16 x i1> %1438, <16 x float> %1437, <16 x float> zeroinitializer
  %1440 = getelementptr inbounds [192 x %struct.Point], ptr %13, i64 0, i64 %1424
  %1441 = load <16 x float>, ptr %1440, align 64
  %1442 = fsub contract <16 x float> %1441, %1219
  %1443 = getelementptr inbounds i8, ptr %1440, i64 64
  %1444 = load <16 x float>, ptr %1443, align 64
  %1445 = fsub contract <16 x float> %1444, %1233
  %1446 = getelementptr inbounds i8, ptr %1440, i64 128
  %1447 = load <16 x float>, ptr %1446, align 64
  %1448 = fsub contract <16 x float> %1447, %1247
  %1449 = fmul contract <16 x float> %1442, %1442
  %1450 = fmul contract <16 x float> %1445, %1445
  %1451 = fadd contract <16 x float> %1449, %1450
  %1452 = fmul contract <16 x float> %1448, %1448
  %1453 = fadd contract <16 x float> %1451, %1452
  %1454 = fmul contract <16 x float> %1439, %1439
  %1455 = fcmp contract olt <16 x float> %1453, %1454
  %1456 = bitcast <16 x i1> %1455 to i16
  %1457 = icmp eq i16 %1456, 0
  br i1 %1457, label %1747, label %1459

1458:
  br i1 %1418, label %1459, label %1747

1459:
  %1460 = phi i64 [ %1424, %1430 ], [ %1419, %1458 ]
  %1461 = getelementptr inbounds i8, ptr %1425, i64 28
  %1462 = load float, ptr %1461, align 4
  %1463 = getelementptr inbounds i8, ptr %1428, i64 28
  %1464 = load float, ptr %1463, align 4
  %1465 = fadd contract float %1462, %1464
  %1466 = insertelement <16 x float> poison, float %1465, i64 0
  %1467 = shufflevector <16 x float> %1466, <16 x float> poison, <16 x i32> zeroinitializer
  %1468 = fadd contract <16 x float> %1195, %1467
  %1469 = fcmp contract ogt <16 x float> %1468, zeroinitializer
  %1470 = select contract <16 x i1> %1469, <16 x float> %1468, <16 x float> zeroinitializer
  %1471 = getelementptr inbounds [192 x %struct.Point], ptr %13, i64 0, i64 %1424
  %1472 = getelementptr inbounds [192 x %struct.Point], ptr %13, i64 0, i64 %1427
  %1473 = load <16 x float>, ptr %1471, align 64
  %1474 = load <16 x float>, ptr %1472, align 64
  %1475 = fsub contract <16 x float> %1473, %1474
  %1476 = getelementptr inbounds i8, ptr %1471, i64 64
  %1477 = load <16 x float>, ptr %1476, align 64
  %1478 = getelementptr inbounds i8, ptr %1472, i64 64
  %1479 = load <16 x float>, ptr %1478, align 64
  %1480 = fsub contract <16 x float> %1477, %1479
  %1481 = getelementptr inbounds i8, ptr %1471, i64 128
  %1482 = load <16 x float>, ptr %1481, align 64
  %1483 = getelementptr inbounds i8, ptr %1472, i64 128
  %1484 = load <16 x float>, ptr %1483, align 64
  %1485 = fsub contract <16 x float> %1482, %1484
  %1486 = fmul contract <16 x float> %1475, %1475
  %1487 = fmul contract <16 x float> %1480, %1480
  %1488 = fadd contract <16 x float> %1486, %1487
  %1489 = fmul contract <16 x float> %1485, %1485
  %1490 = fadd contract <16 x float> %1488, %1489
  %1491 = fmul contract <16 x float> %1470, %1470
  %1492 = fcmp contract olt <16 x float> %1490, %1491
  %1493 = bitcast <16 x i1> %1492 to i16
  %1494 = icmp eq i16 %1493, 0
  br i1 %1494, label %1747, label %1495

1495:
  %1496 = getelementptr inbounds i8, ptr %1425, i64 24
  %1497 = load float, ptr %1496, align 4
  %1498 = getelementptr inbounds i8, ptr %1428, i64 24
  %1499 = load float, ptr %1498, align 4
  %1500 = fadd contract float %1497, %1499
  %1501 = insertelement <16 x float> poison, float %1500, i64 0
  %1502 = shufflevector <16 x float> %1501, <16 x float> poison, <16 x i32> zeroinitializer
  %1503 = fadd contract <16 x float> %1195, %1502
  %1504 = fcmp contract ogt <16 x float> %1503, zeroinitializer
  %1505 = select contract <16 x i1> %1504, <16 x float> %1503, <16 x float> zeroinitializer
  %1506 = getelementptr inbounds i8, ptr %1425, i64 12
  %1507 = load float, ptr %1506, align 4
  %1508 = fmul contract float %1507, %1507
  %1509 = getelementptr inbounds i8, ptr %1425, i64 16
  %1510 = load float, ptr %1509, align 4
  %1511 = fmul contract float %1510, %1510
  %1512 = fadd contract float %1508, %1511
  %1513 = getelementptr inbounds i8, ptr %1425, i64 20
  %1514 = load float, ptr %1513, align 4
  %1515 = fmul contract float %1514, %1514
  %1516 = fadd contract float %1512, %1515
  %1517 = getelementptr inbounds i8, ptr %1428, i64 12
  %1518 = load float, ptr %1517, align 4
  %1519 = fmul contract float %1518, %1518
  %1520 = getelementptr inbounds i8, ptr %1428, i64 16
  %1521 = load float, ptr %1520, align 4
  %1522 = fmul contract float %1521, %1521
  %1523 = fadd contract float %1519, %1522
  %1524 = getelementptr inbounds i8, ptr %1428, i64 20
  %1525 = load float, ptr %1524, align 4
  %1526 = fmul contract float %1525, %1525
  %1527 = fadd contract float %1523, %1526
  %1528 = fcmp contract oeq float %1516, 0.000000e+00
  %1529 = fcmp contract oeq float %1527, 0.000000e+00
  %1530 = select i1 %1528, i1 %1529, i1 false
  br i1 %1530, label %1662, label %1531

1531:
  %1532 = fmul contract <16 x float> %1473, zeroinitializer
  %1533 = fadd contract <16 x float> %1532, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %1534 = insertelement <16 x float> poison, float %1507, i64 0
  %1535 = shufflevector <16 x float> %1534, <16 x float> poison, <16 x i32> zeroinitializer
  %1536 = fmul contract <16 x float> %1265, %1535
  %1537 = insertelement <16 x float> poison, float %1510, i64 0
  %1538 = shufflevector <16 x float> %1537, <16 x float> poison, <16 x i32> zeroinitializer
  %1539 = fmul contract <16 x float> %1271, %1538
  %1540 = fadd contract <16 x float> %1536, %1539
  %1541 = insertelement <16 x float> poison, float %1514, i64 0
  %1542 = shufflevector <16 x float> %1541, <16 x float> poison, <16 x i32> zeroinitializer
  %1543 = fmul contract <16 x float> %1277, %1542
  %1544 = fadd contract <16 x float> %1540, %1543
  %1545 = fmul contract <16 x float> %1285, %1535
  %1546 = fmul contract <16 x float> %1289, %1538
  %1547 = fadd contract <16 x float> %1545, %1546
  %1548 = fmul contract <16 x float> %1293, %1542
  %1549 = fadd contract <16 x float> %1547, %1548
  %1550 = fmul contract <16 x float> %1299, %1535
  %1551 = fmul contract <16 x float> %1303, %1538
  %1552 = fadd contract <16 x float> %1550, %1551
  %1553 = fmul contract <16 x float> %1307, %1542
  %1554 = fadd contract <16 x float> %1552, %1553
  %1555 = insertelement <16 x float> poison, float %1518, i64 0
  %1556 = shufflevector <16 x float> %1555, <16 x float> poison, <16 x i32> zeroinitializer
  %1557 = fmul contract <16 x float> %1203, %1556
  %1558 = insertelement <16 x float> poison, float %1521, i64 0
  %1559 = shufflevector <16 x float> %1558, <16 x float> poison, <16 x i32> zeroinitializer
  %1560 = fmul contract <16 x float> %1209, %1559
  %1561 = fadd contract <16 x float> %1557, %1560
  %1562 = insertelement <16 x float> poison, float %1525, i64 0
  %1563 = shufflevector <16 x float> %1562, <16 x float> poison, <16 x i32> zeroinitializer
  %1564 = fmul contract <16 x float> %1215, %1563
  %1565 = fadd contract <16 x float> %1561, %1564
  %1566 = fmul contract <16 x float> %1223, %1556
  %1567 = fmul contract <16 x float> %1227, %1559
  %1568 = fadd contract <16 x float> %1566, %1567
  %1569 = fmul contract <16 x float> %1231, %1563
  %1570 = fadd contract <16 x float> %1568, %1569
  %1571 = fmul contract <16 x float> %1237, %1556
  %1572 = fmul contract <16 x float> %1241, %1559
  %1573 = fadd contract <16 x float> %1571, %1572
  %1574 = fmul contract <16 x float> %1245, %1563
  %1575 = fadd contract <16 x float> %1573, %1574
  %1576 = fcmp contract ogt float %1516, 0.000000e+00
  %1577 = fdiv contract float 1.000000e+00, %1516
  %1578 = select contract i1 %1576, float %1577, float 0.000000e+00
  %1579 = fcmp contract ogt float %1527, 0.000000e+00
  %1580 = fdiv contract float 1.000000e+00, %1527
  %1581 = select contract i1 %1579, float %1580, float 0.000000e+00
  %1582 = fmul contract <16 x float> %1544, %1565
  %1583 = fmul contract <16 x float> %1549, %1570
  %1584 = fadd contract <16 x float> %1582, %1583
  %1585 = fmul contract <16 x float> %1554, %1575
  %1586 = fadd contract <16 x float> %1585, %1584
  %1587 = fmul contract <16 x float> %1475, %1544
  %1588 = fmul contract <16 x float> %1480, %1549
  %1589 = fadd contract <16 x float> %1587, %1588
  %1590 = fmul contract <16 x float> %1485, %1554
  %1591 = fadd contract <16 x float> %1590, %1589
  %1592 = fmul contract <16 x float> %1475, %1565
  %1593 = fmul contract <16 x float> %1480, %1570
  %1594 = fadd contract <16 x float> %1592, %1593
  %1595 = fmul contract <16 x float> %1485, %1575
  %1596 = fadd contract <16 x float> %1595, %1594
  %1597 = fmul contract float %1516, %1527
  %1598 = insertelement <16 x float> poison, float %1597, i64 0
  %1599 = shufflevector <16 x float> %1598, <16 x float> poison, <16 x i32> zeroinitializer
  %1600 = fmul contract <16 x float> %1586, %1586
  %1601 = fsub contract <16 x float> %1599, %1600
  %1602 = fmul contract float %1516, 0x3E7AD7F2A0000000
  %1603 = fmul contract float %1602, %1527
  %1604 = insertelement <16 x float> poison, float %1603, i64 0
  %1605 = shufflevector <16 x float> %1604, <16 x float> poison, <16 x i32> zeroinitializer
  %1606 = fcmp contract ogt <16 x float> %1601, %1605
  %1607 = fmul contract <16 x float> %1586, %1596
  %1608 = insertelement <16 x float> poison, float %1527, i64 0
  %1609 = shufflevector <16 x float> %1608, <16 x float> poison, <16 x i32> zeroinitializer
  %1610 = fmul contract <16 x float> %1609, %1591
  %1611 = fsub contract <16 x float> %1607, %1610
  %1612 = select contract <16 x i1> %1606, <16 x float> %1601, <16 x float> %1533
  %1613 = fdiv contract <16 x float> %1611, %1612
  %1614 = fneg contract <16 x float> %1533
  %1615 = fcmp contract ogt <16 x float> %1613, %1614
  %1616 = select contract <16 x i1> %1615, <16 x float> %1613, <16 x float> %1614
  %1617 = fcmp contract olt <16 x float> %1616, %1533
  %1618 = select contract <16 x i1> %1617, <16 x float> %1616, <16 x float> %1533
  %1619 = select contract <16 x i1> %1606, <16 x float> %1618, <16 x float> %1614
  %1620 = fmul contract <16 x float> %1586, %1619
  %1621 = fadd contract <16 x float> %1596, %1620
  %1622 = insertelement <16 x float> poison, float %1581, i64 0
  %1623 = shufflevector <16 x float> %1622, <16 x float> poison, <16 x i32> zeroinitializer
  %1624 = fmul contract <16 x float> %1623, %1621
  %1625 = fcmp contract ogt <16 x float> %1624, %1614
  %1626 = select contract <16 x i1> %1625, <16 x float> %1624, <16 x float> %1614
  %1627 = fcmp contract olt <16 x float> %1626, %1533
  %1628 = select contract <16 x i1> %1627, <16 x float> %1626, <16 x float> %1533
  %1629 = fmul contract <16 x float> %1586, %1628
  %1630 = fsub contract <16 x float> %1629, %1591
  %1631 = insertelement <16 x float> poison, float %1578, i64 0
  %1632 = shufflevector <16 x float> %1631, <16 x float> poison, <16 x i32> zeroinitializer
  %1633 = fmul contract <16 x float> %1632, %1630
  %1634 = fcmp contract ogt <16 x float> %1633, %1614
  %1635 = select contract <16 x i1> %1634, <16 x float> %1633, <16 x float> %1614
  %1636 = fcmp contract olt <16 x float> %1635, %1533
  %1637 = select contract <16 x i1> %1636, <16 x float> %1635, <16 x float> %1533
  %1638 = fmul contract <16 x float> %1586, %1637
  %1639 = fadd contract <16 x float> %1596, %1638
  %1640 = fmul contract <16 x float> %1623, %1639
  %1641 = fcmp contract ogt <16 x float> %1640, %1614
  %1642 = select contract <16 x i1> %1641, <16 x float> %1640, <16 x float> %1614
  %1643 = fcmp contract olt <16 x float> %1642, %1533
  %1644 = select contract <16 x i1> %1643, <16 x float> %1642, <16 x float> %1533
  %1645 = fmul contract <16 x float> %1544, %1637
  %1646 = fadd contract <16 x float> %1475, %1645
  %1647 = fmul contract <16 x float> %1565, %1644
  %1648 = fsub contract <16 x float> %1646, %1647
  %1649 = fmul contract <16 x float> %1549, %1637
  %1650 = fadd contract <16 x float> %1480, %1649
  %1651 = fmul contract <16 x float> %1570, %1644
  %1652 = fsub contract <16 x float> %1650, %1651
  %1653 = fmul contract <16 x float> %1554, %1637
  %1654 = fadd contract <16 x float> %1485, %1653
  %1655 = fmul contract <16 x float> %1575, %1644
  %1656 = fsub contract <16 x float> %1654, %1655
  %1657 = fmul contract <16 x float> %1648, %1648
  %1658 = fmul contract <16 x float> %1652, %1652
  %1659 = fadd contract <16 x float> %1657, %1658
  %1660 = fmul contract <16 x float> %1656, %1656
  %1661 = fadd contract <16 x float> %1660, %1659
  br label %1662

1662:
  %1663 = phi <16 x float> [ %1661, %1531 ], [ %1490, %1495 ]
  %1664 = fmul contract <16 x float> %1505, %1505
  %1665 = fcmp contract olt <16 x float> %1663, %1664
  %1666 = select <16 x i1> %1665, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %1416
  %1667 = load i64, ptr %0, align 8
  %1668 = load i64, ptr %46, align 8
  %1669 = mul nsw i64 %1668, %1667
  %1670 = add nsw i64 %1669, %1417
  %1671 = bitcast <16 x i1> %1665 to i16
  %1672 = zext i16 %1671 to i64
  %1673 = and i64 %181, %1672
  %1674 = icmp eq i64 %1673, 0
  br i1 %1674, label %1747, label %1675

1675:
  %1676 = load i64, ptr %1183, align 8
  %1677 = load i64, ptr %1179, align 8
  %1678 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %29, i64 0, i64 %1676, i64 %1677
  %1679 = load <16 x float>, ptr %1678, align 64
  %1680 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %1676, i64 %1677
  %1681 = load <16 x float>, ptr %1680, align 64
  %1682 = and i64 %1673, %111
  %1683 = icmp eq i64 %1682, 0
  br i1 %1683, label %1747, label %1684

1684:
  %1685 = phi i64 [ %1743, %1742 ], [ %1420, %1675 ]
  %1686 = phi i64 [ %1745, %1742 ], [ %1682, %1675 ]
  %1687 = tail call range(i64 0, 65) i64 @llvm.cttz.i64(i64 %1686, i1 true)
  %1688 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %1687
  %1689 = getelementptr inbounds i8, ptr %1688, i64 8
  %1690 = load float, ptr %1689, align 8
  %1691 = getelementptr inbounds i8, ptr %1688, i64 12
  %1692 = load float, ptr %1691, align 4
  %1693 = fcmp contract une float %1690, %1692
  br i1 %1693, label %1694, label %1742

1694:
  %1695 = load i64, ptr %1688, align 16
  %1696 = extractelement <16 x float> %1679, i64 %1687
  %1697 = extractelement <16 x float> %1681, i64 %1687
  %1698 = extractelement <16 x float> %577, i64 %1687
  %1699 = fmul contract float %1697, %1698
  %1700 = fadd contract float %1696, %1699
  %1701 = fpext float %1700 to double
  %1702 = fmul contract double %1701, 1.001000e+00
  %1703 = icmp sle i64 %1685, %4
  %1704 = icmp sgt i64 %1685, 0
  %1705 = and i1 %1703, %1704
  br i1 %1705, label %1706, label %1730

1706:
  %1707 = tail call i64 @llvm.umax.i64(i64 %1685, i64 64)
  %1708 = add nsw i64 %1707, -63
  br label %1709

1709:
  %1710 = phi i64 [ %1711, %1728 ], [ %1685, %1706 ]
  %1711 = add nsw i64 %1710, -1
  %1712 = getelementptr inbounds %struct.Contact, ptr %3, i64 %1711
  %1713 = getelementptr inbounds i8, ptr %1712, i64 16
  %1714 = load i64, ptr %1713, align 8
  %1715 = icmp eq i64 %1714, %1670
  br i1 %1715, label %1716, label %1728

1716:
  %1717 = load i64, ptr %1712, align 8
  %1718 = icmp eq i64 %1717, %1695
  br i1 %1718, label %1719, label %1728

1719:
  %1720 = getelementptr inbounds i8, ptr %1712, i64 12
  %1721 = load float, ptr %1720, align 4
  %1722 = fcmp contract une float %1721, %1690
  br i1 %1722, label %1728, label %1723

1723:
  %1724 = getelementptr inbounds i8, ptr %1712, i64 12
  store float %1692, ptr %1724, align 4
  %1725 = getelementptr inbounds i8, ptr %1712, i64 24
  %1726 = load double, ptr %1725, align 8
  %1727 = fcmp contract ogt double %1702, %1726
  br i1 %1727, label %1739, label %1742

1728:
  %1729 = icmp sgt i64 %1710, %1708
  br i1 %1729, label %1709, label %1730

1730:
  %1731 = add i64 %1685, 1
  %1732 = icmp slt i64 %1685, %4
  br i1 %1732, label %1733, label %1742

1733:
  %1734 = getelementptr inbounds %struct.Contact, ptr %3, i64 %1685
  store i64 %1695, ptr %1734, align 8
  %1735 = getelementptr inbounds i8, ptr %1734, i64 8
  store float %1690, ptr %1735, align 8
  %1736 = getelementptr inbounds i8, ptr %1734, i64 12
  store float %1692, ptr %1736, align 4
  %1737 = getelementptr inbounds i8, ptr %1734, i64 16
  store i64 %1670, ptr %1737, align 8
  %1738 = getelementptr inbounds i8, ptr %1734, i64 24
  br label %1739

1739:
  %1740 = phi i64 [ %1731, %1733 ], [ %1685, %1723 ]
  %1741 = phi ptr [ %1738, %1733 ], [ %1725, %1723 ]
  store double %1702, ptr %1741, align 8
  br label %1742

1742:
  %1743 = phi i64 [ %1740, %1739 ], [ %1731, %1730 ], [ %1685, %1723 ], [ %1685, %1684 ]
  %1744 = add nsw i64 %1686, -1
  %1745 = and i64 %1744, %1686
  %1746 = icmp eq i64 %1745, 0
  br i1 %1746, label %1747, label %1684

1747:
  %1748 = phi i1 [ true, %1459 ], [ false, %1458 ], [ true, %1662 ], [ true, %1675 ], [ false, %1430 ], [ true, %1742 ]
  %1749 = phi i64 [ %1460, %1459 ], [ %1419, %1458 ], [ %1460, %1662 ], [ %1460, %1675 ], [ %1424, %1430 ], [ %1460, %1742 ]
  %1750 = phi i64 [ %1420, %1459 ], [ %1420, %1458 ], [ %1420, %1662 ], [ %1420, %1675 ], [ %1420, %1430 ], [ %1743, %1742 ]
  %1751 = phi <16 x i32> [ %1416, %1459 ], [ %1416, %1458 ], [ %1666, %1662 ], [ %1666, %1675 ], [ %1416, %1430 ], [ %1666, %1742 ]
  %1752 = add nsw i64 %1417, 1
  %1753 = load i64, ptr %1326, align 8
  %1754 = icmp slt i64 %1752, %1753
  br i1 %1754, label %1415, label %1412

1755:
  %1756 = phi i64 [ %1413, %1412 ], [ %1177, %1173 ]
  %1757 = phi i64 [ %1409, %1412 ], [ %1175, %1173 ]
  %1758 = phi <16 x i32> [ %1414, %1412 ], [ %1174, %1173 ]
  %1759 = add nuw nsw i64 %1176, 1
  %1760 = load i64, ptr %43, align 8
  %1761 = icmp slt i64 %1759, %1760
  br i1 %1761, label %1173, label %1762

1762:
  %1763 = phi i64 [ %756, %754 ], [ %1756, %1755 ]
  %1764 = phi <16 x i32> [ %757, %754 ], [ %1758, %1755 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %13)
  %1765 = icmp ne <16 x i32> %1764, zeroinitializer
  %1766 = bitcast <16 x i1> %1765 to i16
  %1767 = zext i16 %1766 to i64
  call void @llvm.lifetime.end.p0(i64 18496, ptr nonnull %29)
  call void @llvm.lifetime.end.p0(i64 18496, ptr nonnull %28)
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %27)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %26)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %25)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %24)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %23)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %22)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %21)
  call void @llvm.lifetime.end.p0(i64 8704, ptr nonnull %20)
  call void @llvm.lifetime.end.p0(i64 1088, ptr nonnull %19)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %18)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %17)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %16)
  %1768 = and i64 %1767, %111
  %1769 = icmp eq i64 %1768, 0
  br i1 %1769, label %1812, label %1775

1770:
  %1771 = phi i64 [ %1773, %1770 ], [ %72, %103 ]
  %1772 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %1771
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 16 dereferenceable(16) %1772, ptr noundef nonnull align 16 dereferenceable(16) %31, i64 16, i1 false)
  %1773 = add nuw i64 %1771, 1
  %1774 = icmp eq i64 %1773, 16
  br i1 %1774, label %106, label %1770

1775:
  %1776 = phi i64 [ %1808, %1806 ], [ %109, %1762 ]
  %1777 = phi i64 [ %1810, %1806 ], [ %1768, %1762 ]
  %1778 = tail call range(i64 0, 65) i64 @llvm.ctlz.i64(i64 %1777, i1 true)
  %1779 = xor i64 %1778, 63
  %1780 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %1779
  %1781 = load i64, ptr %1780, align 16
  %1782 = getelementptr inbounds i8, ptr %1780, i64 8
  %1783 = load float, ptr %1782, align 8
  %1784 = getelementptr inbounds i8, ptr %1780, i64 12
  %1785 = load float, ptr %1784, align 4
  %1786 = fadd contract float %1783, %1785
  %1787 = fmul contract float %1786, 5.000000e-01
  %1788 = fcmp contract oeq float %1783, %1785
  br i1 %1788, label %1789, label %1792

1789:
  %1790 = getelementptr inbounds i8, ptr %5, i64 %1781
  store i8 1, ptr %1790, align 1
  %1791 = shl nuw nsw i64 1, %1779
  br label %1806

1792:
  %1793 = shl nuw nsw i64 1, %1779
  %1794 = and i64 %1793, %181
  %1795 = icmp eq i64 %1794, 0
  %1796 = add nsw i64 %1776, 1
  %1797 = getelementptr inbounds [4096 x %struct.SpanPiece], ptr %30, i64 0, i64 %1776
  store i64 %1781, ptr %1797, align 16
  %1798 = getelementptr inbounds i8, ptr %1797, i64 8
  %1799 = getelementptr inbounds i8, ptr %1797, i64 12
  br i1 %1795, label %1801, label %1800

1800:
  store float %1785, ptr %1798, align 8
  store float %1785, ptr %1799, align 4
  br label %1806

1801:
  store float %1787, ptr %1798, align 8
  store float %1785, ptr %1799, align 4
  %1802 = add nsw i64 %1776, 2
  %1803 = getelementptr inbounds [4096 x %struct.SpanPiece], ptr %30, i64 0, i64 %1796
  store i64 %1781, ptr %1803, align 16
  %1804 = getelementptr inbounds i8, ptr %1803, i64 8
  store float %1783, ptr %1804, align 8
  %1805 = getelementptr inbounds i8, ptr %1803, i64 12
  store float %1787, ptr %1805, align 4
  br label %1806

1806:
  %1807 = phi i64 [ %1793, %1800 ], [ %1793, %1801 ], [ %1791, %1789 ]
  %1808 = phi i64 [ %1796, %1800 ], [ %1802, %1801 ], [ %1776, %1789 ]
  %1809 = xor i64 %1807, -1
  %1810 = and i64 %1777, %1809
  %1811 = icmp eq i64 %1810, 0
  br i1 %1811, label %1812, label %1775

1812:
  %1813 = phi i64 [ %109, %1762 ], [ %1808, %1806 ]
  call void @llvm.lifetime.end.p0(i64 256, ptr nonnull %31)
  %1814 = icmp ne i64 %1813, 0
  %1815 = icmp slt i64 %108, %2
  %1816 = select i1 %1814, i1 true, i1 %1815
  br i1 %1816, label %61, label %1817

1817:
  %1818 = phi i64 [ %64, %105 ], [ 0, %33 ], [ 0, %6 ], [ %1763, %1812 ]
  call void @llvm.lifetime.end.p0(i64 65536, ptr nonnull %30)
  ret i64 %1818
}

declare void @llvm.memcpy.p0.p0.i64(ptr noalias nocapture writeonly, ptr noalias nocapture readonly, i64, i1 immarg)

declare i64 @llvm.ctlz.i64(i64, i1 immarg)

define i64 @search_route(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, i64 noundef %5, ptr nocapture noundef %6, ptr nocapture noundef writeonly %7) {
  %9 = alloca <16 x float>, align 64
  %10 = alloca <16 x float>, align 64
  %11 = alloca <16 x float>, align 64
  %12 = alloca <16 x float>, align 64
  %13 = alloca [2 x %struct.Tree], align 16
  %14 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  store i64 %5, ptr %14, align 8
  %15 = load <16 x float>, ptr %2, align 4
  call void @llvm.lifetime.start.p0(i64 48, ptr nonnull %13)
  %16 = getelementptr inbounds i8, ptr %1, i64 64
  %17 = load ptr, ptr %16, align 8
  store ptr %17, ptr %13, align 16
  %18 = getelementptr inbounds i8, ptr %13, i64 8
  %19 = getelementptr inbounds i8, ptr %1, i64 72
  %20 = load ptr, ptr %19, align 8
  store ptr %20, ptr %18, align 8
  %21 = getelementptr inbounds i8, ptr %13, i64 16
  %22 = getelementptr inbounds i8, ptr %13, i64 24
  %23 = getelementptr inbounds i8, ptr %1, i64 40
  %24 = load i64, ptr %23, align 8
  %25 = getelementptr inbounds <16 x float>, ptr %17, i64 %24
  store ptr %25, ptr %22, align 8
  %26 = getelementptr inbounds i8, ptr %13, i64 32
  %27 = getelementptr inbounds i32, ptr %20, i64 %24
  store ptr %27, ptr %26, align 16
  %28 = getelementptr inbounds i8, ptr %13, i64 40
  store i64 0, ptr %28, align 8
  store <16 x float> %15, ptr %17, align 4
  store i64 1, ptr %21, align 16
  store i32 -1, ptr %20, align 4
  %29 = icmp sgt i64 %4, 0
  br i1 %29, label %47, label %31

30:
  store i64 %4, ptr %28, align 8
  br label %31

31:
  %32 = load ptr, ptr %1, align 8
  %33 = load <16 x float>, ptr %32, align 4
  %34 = getelementptr inbounds i8, ptr %1, i64 8
  %35 = load ptr, ptr %34, align 8
  %36 = load <16 x float>, ptr %35, align 4
  %37 = getelementptr inbounds i8, ptr %1, i64 48
  %38 = load i64, ptr %37, align 8
  %39 = icmp sgt i64 %38, 0
  br i1 %39, label %40, label %433

40:
  %41 = getelementptr inbounds i8, ptr %1, i64 24
  %42 = getelementptr inbounds i8, ptr %1, i64 16
  %43 = getelementptr inbounds i8, ptr %1, i64 32
  %44 = getelementptr inbounds i8, ptr %1, i64 80
  %45 = getelementptr inbounds i8, ptr %1, i64 84
  %46 = getelementptr inbounds i8, ptr %1, i64 88
  br label %55

47:
  %48 = phi i64 [ %52, %47 ], [ 0, %8 ]
  %49 = getelementptr inbounds <16 x float>, ptr %3, i64 %48
  %50 = load <16 x float>, ptr %49, align 4
  %51 = getelementptr inbounds <16 x float>, ptr %25, i64 %48
  store <16 x float> %50, ptr %51, align 4
  %52 = add nuw nsw i64 %48, 1
  %53 = getelementptr inbounds i32, ptr %27, i64 %48
  store i32 -1, ptr %53, align 4
  %54 = icmp eq i64 %52, %4
  br i1 %54, label %30, label %47

55:
  %56 = phi i64 [ %38, %40 ], [ %430, %429 ]
  %57 = phi i64 [ %5, %40 ], [ %83, %429 ]
  %58 = phi i64 [ 0, %40 ], [ %431, %429 ]
  %59 = load i64, ptr %21, align 16
  %60 = load i64, ptr %28, align 8
  %61 = icmp sgt i64 %59, %60
  %62 = zext i1 %61 to i64
  %63 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %62
  %64 = xor i1 %61, true
  %65 = zext i1 %64 to i64
  %66 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %65
  %67 = getelementptr inbounds i8, ptr %63, i64 16
  %68 = load i64, ptr %67, align 8
  %69 = load i64, ptr %23, align 8
  %70 = icmp slt i64 %68, %69
  br i1 %70, label %71, label %433

71:
  %72 = getelementptr inbounds i8, ptr %66, i64 16
  %73 = load i64, ptr %72, align 8
  %74 = icmp slt i64 %73, %69
  br i1 %74, label %75, label %433

75:
  %76 = load i64, ptr %0, align 8
  %77 = icmp sgt i64 %76, 0
  br i1 %77, label %78, label %82

78:
  %79 = mul i64 %76, -7046029254386353131
  br label %185

80:
  %81 = add i64 %79, %57
  br label %82

82:
  %83 = phi i64 [ %57, %75 ], [ %81, %80 ]
  %84 = phi <16 x float> [ %33, %75 ], [ %205, %80 ]
  %85 = load ptr, ptr %63, align 8
  %86 = load ptr, ptr %41, align 8
  %87 = load <16 x float>, ptr %86, align 4
  %88 = fcmp contract oeq <16 x float> %87, zeroinitializer
  %89 = select contract <16 x i1> %88, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %90 = fadd contract <16 x float> %87, %89
  %91 = load ptr, ptr %42, align 8
  %92 = load <16 x float>, ptr %91, align 4
  %93 = icmp sgt i64 %68, 1
  br i1 %93, label %94, label %149

94:
  %95 = load <16 x float>, ptr %85, align 4
  %96 = fsub contract <16 x float> %84, %95
  %97 = fdiv contract <16 x float> %96, %90
  %98 = fadd contract <16 x float> %97, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %99 = fadd contract <16 x float> %98, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %100 = fmul contract <16 x float> %87, %99
  %101 = fsub contract <16 x float> %96, %100
  %102 = fmul contract <16 x float> %92, %101
  %103 = fmul contract <16 x float> %102, %102
  %104 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %105 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %106 = fadd contract <8 x float> %104, %105
  %107 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %108 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %109 = fadd contract <4 x float> %107, %108
  %110 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %111 = fadd contract <4 x float> %109, %110
  %112 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %113 = fadd contract <4 x float> %109, %112
  %114 = shufflevector <4 x float> %113, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %115 = fadd contract <4 x float> %111, %114
  %116 = extractelement <4 x float> %115, i64 0
  br label %117

117:
  %118 = phi i64 [ %146, %117 ], [ 0, %94 ]
  %119 = phi i64 [ %147, %117 ], [ 1, %94 ]
  %120 = phi float [ %145, %117 ], [ %116, %94 ]
  %121 = getelementptr inbounds <16 x float>, ptr %85, i64 %119
  %122 = load <16 x float>, ptr %121, align 4
  %123 = fsub contract <16 x float> %84, %122
  %124 = fdiv contract <16 x float> %123, %90
  %125 = fadd contract <16 x float> %124, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %126 = fadd contract <16 x float> %125, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %127 = fmul contract <16 x float> %87, %126
  %128 = fsub contract <16 x float> %123, %127
  %129 = fmul contract <16 x float> %92, %128
  %130 = fmul contract <16 x float> %129, %129
  %131 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %132 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %133 = fadd contract <8 x float> %131, %132
  %134 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %135 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %136 = fadd contract <4 x float> %134, %135
  %137 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %138 = fadd contract <4 x float> %136, %137
  %139 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %140 = fadd contract <4 x float> %136, %139
  %141 = shufflevector <4 x float> %140, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %142 = fadd contract <4 x float> %138, %141
  %143 = extractelement <4 x float> %142, i64 0
  %144 = fcmp contract olt float %143, %120
  %145 = select i1 %144, float %143, float %120
  %146 = select i1 %144, i64 %119, i64 %118
  %147 = add nuw nsw i64 %119, 1
  %148 = icmp eq i64 %147, %68
  br i1 %148, label %149, label %117

149:
  %150 = phi i64 [ 0, %82 ], [ %146, %117 ]
  %151 = getelementptr inbounds <16 x float>, ptr %85, i64 %150
  %152 = load <16 x float>, ptr %151, align 4
  %153 = fsub contract <16 x float> %84, %152
  %154 = fdiv contract <16 x float> %153, %90
  %155 = fadd contract <16 x float> %154, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %156 = fadd contract <16 x float> %155, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %157 = fmul contract <16 x float> %87, %156
  %158 = fsub contract <16 x float> %153, %157
  %159 = load i64, ptr %43, align 8
  %160 = icmp eq i64 %159, 0
  %161 = fmul contract <16 x float> %92, %158
  br i1 %160, label %162, label %178

162:
  %163 = fmul contract <16 x float> %161, %161
  %164 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %165 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %166 = fadd contract <8 x float> %164, %165
  %167 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %168 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %169, %170
  %172 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = shufflevector <4 x float> %173, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %175 = fadd contract <4 x float> %171, %174
  %176 = extractelement <4 x float> %175, i64 0
  %177 = tail call contract float @llvm.sqrt.f32(float %176)
  br label %181

178:
  %179 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %161)
  %180 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %179)
  br label %181

181:
  %182 = phi float [ %180, %178 ], [ %177, %162 ]
  %183 = load float, ptr %44, align 8
  %184 = fcmp contract ogt float %182, %183
  br i1 %184, label %208, label %213

185:
  %186 = phi i64 [ %192, %185 ], [ %57, %78 ]
  %187 = phi <16 x float> [ %205, %185 ], [ %33, %78 ]
  %188 = phi i64 [ %206, %185 ], [ 0, %78 ]
  %189 = extractelement <16 x float> %36, i64 %188
  %190 = extractelement <16 x float> %33, i64 %188
  %191 = fsub contract float %189, %190
  %192 = add i64 %186, -7046029254386353131
  %193 = lshr i64 %192, 30
  %194 = xor i64 %193, %192
  %195 = mul i64 %194, -4658895280553007687
  %196 = lshr i64 %195, 27
  %197 = xor i64 %196, %195
  %198 = mul i64 %197, -7723592293110705685
  %199 = lshr i64 %198, 40
  %200 = uitofp nneg i64 %199 to float
  %201 = fmul contract float %200, 0x3E70000000000000
  %202 = fmul contract float %191, %201
  %203 = extractelement <16 x float> %187, i64 %188
  %204 = fadd contract float %203, %202
  %205 = insertelement <16 x float> %187, float %204, i64 %188
  %206 = add nuw nsw i64 %188, 1
  %207 = icmp eq i64 %206, %76
  br i1 %207, label %80, label %185

208:
  %209 = fdiv contract float %183, %182
  %210 = insertelement <16 x float> poison, float %209, i64 0
  %211 = shufflevector <16 x float> %210, <16 x float> poison, <16 x i32> zeroinitializer
  %212 = fmul contract <16 x float> %158, %211
  br label %213

213:
  %214 = phi <16 x float> [ %212, %208 ], [ %158, %181 ]
  %215 = fcmp contract oeq float %182, 0.000000e+00
  br i1 %215, label %429, label %216

216:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %10)
  store <16 x float> %152, ptr %9, align 64
  store <16 x float> %214, ptr %10, align 64
  %217 = load float, ptr %45, align 4
  %218 = load float, ptr %46, align 8
  %219 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %9, ptr noundef nonnull %10, float noundef %217, float noundef %218)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %10)
  br i1 %219, label %220, label %429

220:
  %221 = fadd contract <16 x float> %152, %214
  %222 = getelementptr inbounds <16 x float>, ptr %85, i64 %68
  store <16 x float> %221, ptr %222, align 4
  %223 = trunc i64 %150 to i32
  %224 = getelementptr inbounds i8, ptr %63, i64 8
  %225 = load ptr, ptr %224, align 8
  %226 = add nsw i64 %68, 1
  store i64 %226, ptr %67, align 8
  %227 = getelementptr inbounds i32, ptr %225, i64 %68
  store i32 %223, ptr %227, align 4
  %228 = getelementptr <16 x float>, ptr %85, i64 %226
  %229 = getelementptr i8, ptr %228, i64 -64
  %230 = load <16 x float>, ptr %229, align 4
  %231 = load ptr, ptr %66, align 8
  %232 = load ptr, ptr %41, align 8
  %233 = load <16 x float>, ptr %232, align 4
  %234 = fcmp contract oeq <16 x float> %233, zeroinitializer
  %235 = select contract <16 x i1> %234, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %236 = fadd contract <16 x float> %233, %235
  %237 = load ptr, ptr %42, align 8
  %238 = load <16 x float>, ptr %237, align 4
  %239 = icmp sgt i64 %73, 1
  br i1 %239, label %240, label %295

240:
  %241 = load <16 x float>, ptr %231, align 4
  %242 = fsub contract <16 x float> %230, %241
  %243 = fdiv contract <16 x float> %242, %236
  %244 = fadd contract <16 x float> %243, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %245 = fadd contract <16 x float> %244, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %246 = fmul contract <16 x float> %233, %245
  %247 = fsub contract <16 x float> %242, %246
  %248 = fmul contract <16 x float> %238, %247
  %249 = fmul contract <16 x float> %248, %248
  %250 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %251 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %252 = fadd contract <8 x float> %250, %251
  %253 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %254 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %255 = fadd contract <4 x float> %253, %254
  %256 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %257 = fadd contract <4 x float> %255, %256
  %258 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %259 = fadd contract <4 x float> %255, %258
  %260 = shufflevector <4 x float> %259, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %261 = fadd contract <4 x float> %257, %260
  %262 = extractelement <4 x float> %261, i64 0
  br label %263

263:
  %264 = phi i64 [ %292, %263 ], [ 0, %240 ]
  %265 = phi i64 [ %293, %263 ], [ 1, %240 ]
  %266 = phi float [ %291, %263 ], [ %262, %240 ]
  %267 = getelementptr inbounds <16 x float>, ptr %231, i64 %265
  %268 = load <16 x float>, ptr %267, align 4
  %269 = fsub contract <16 x float> %230, %268
  %270 = fdiv contract <16 x float> %269, %236
  %271 = fadd contract <16 x float> %270, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %272 = fadd contract <16 x float> %271, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %273 = fmul contract <16 x float> %233, %272
  %274 = fsub contract <16 x float> %269, %273
  %275 = fmul contract <16 x float> %238, %274
  %276 = fmul contract <16 x float> %275, %275
  %277 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %278 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %279 = fadd contract <8 x float> %277, %278
  %280 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %281 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %282 = fadd contract <4 x float> %280, %281
  %283 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %284 = fadd contract <4 x float> %282, %283
  %285 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %286 = fadd contract <4 x float> %282, %285
  %287 = shufflevector <4 x float> %286, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %288 = fadd contract <4 x float> %284, %287
  %289 = extractelement <4 x float> %288, i64 0
  %290 = fcmp contract olt float %289, %266
  %291 = select i1 %290, float %289, float %266
  %292 = select i1 %290, i64 %265, i64 %264
  %293 = add nuw nsw i64 %265, 1
  %294 = icmp eq i64 %293, %73
  br i1 %294, label %295, label %263

295:
  %296 = phi i64 [ 0, %220 ], [ %292, %263 ]
  %297 = getelementptr inbounds i8, ptr %66, i64 8
  br label %298

298:
  %299 = phi i64 [ %73, %295 ], [ %425, %424 ]
  %300 = phi i64 [ %296, %295 ], [ %426, %424 ]
  %301 = getelementptr inbounds <16 x float>, ptr %231, i64 %300
  %302 = load <16 x float>, ptr %301, align 4
  %303 = fsub contract <16 x float> %230, %302
  %304 = load ptr, ptr %41, align 8
  %305 = load <16 x float>, ptr %304, align 4
  %306 = fcmp contract oeq <16 x float> %305, zeroinitializer
  %307 = select contract <16 x i1> %306, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %308 = fadd contract <16 x float> %305, %307
  %309 = fdiv contract <16 x float> %303, %308
  %310 = fadd contract <16 x float> %309, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %311 = fadd contract <16 x float> %310, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %312 = fmul contract <16 x float> %305, %311
  %313 = fsub contract <16 x float> %303, %312
  %314 = load i64, ptr %43, align 8
  %315 = icmp eq i64 %314, 0
  %316 = load ptr, ptr %42, align 8
  %317 = load <16 x float>, ptr %316, align 4
  %318 = fmul contract <16 x float> %317, %313
  br i1 %315, label %319, label %335

319:
  %320 = fmul contract <16 x float> %318, %318
  %321 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %322 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %323 = fadd contract <8 x float> %321, %322
  %324 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %325 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %326 = fadd contract <4 x float> %324, %325
  %327 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %328 = fadd contract <4 x float> %326, %327
  %329 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %330 = fadd contract <4 x float> %326, %329
  %331 = shufflevector <4 x float> %330, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %332 = fadd contract <4 x float> %328, %331
  %333 = extractelement <4 x float> %332, i64 0
  %334 = tail call contract float @llvm.sqrt.f32(float %333)
  br label %338

335:
  %336 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %318)
  %337 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %336)
  br label %338

338:
  %339 = phi float [ %337, %335 ], [ %334, %319 ]
  %340 = load float, ptr %44, align 8
  %341 = fcmp contract ugt float %339, %340
  br i1 %341, label %342, label %347

342:
  %343 = fdiv contract float %340, %339
  %344 = insertelement <16 x float> poison, float %343, i64 0
  %345 = shufflevector <16 x float> %344, <16 x float> poison, <16 x i32> zeroinitializer
  %346 = fmul contract <16 x float> %313, %345
  br label %347

347:
  %348 = phi <16 x float> [ %313, %338 ], [ %346, %342 ]
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %12)
  store <16 x float> %302, ptr %11, align 64
  store <16 x float> %348, ptr %12, align 64
  %349 = load float, ptr %45, align 4
  %350 = load float, ptr %46, align 8
  %351 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %11, ptr noundef nonnull %12, float noundef %349, float noundef %350)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %12)
  br i1 %351, label %352, label %427

352:
  br i1 %341, label %414, label %353

353:
  %354 = select i1 %61, i64 %300, i64 %68
  %355 = select i1 %61, i64 %68, i64 %300
  %356 = icmp slt i64 %354, 0
  br i1 %356, label %375, label %362

357:
  %358 = lshr i64 %369, 1
  %359 = icmp eq i64 %364, 0
  br i1 %359, label %375, label %360

360:
  %361 = getelementptr <16 x float>, ptr %6, i64 %369
  br label %378

362:
  %363 = phi i64 [ %373, %366 ], [ %354, %353 ]
  %364 = phi i64 [ %369, %366 ], [ 0, %353 ]
  %365 = icmp eq i64 %364, 256
  br i1 %365, label %433, label %366

366:
  %367 = getelementptr inbounds <16 x float>, ptr %17, i64 %363
  %368 = load <16 x float>, ptr %367, align 4
  %369 = add nuw nsw i64 %364, 1
  %370 = getelementptr inbounds <16 x float>, ptr %6, i64 %364
  store <16 x float> %368, ptr %370, align 4
  %371 = getelementptr inbounds i32, ptr %20, i64 %363
  %372 = load i32, ptr %371, align 4
  %373 = zext nneg i32 %372 to i64
  %374 = icmp slt i32 %372, 0
  br i1 %374, label %357, label %362

375:
  %376 = phi i64 [ 1, %357 ], [ 0, %353 ], [ %369, %378 ]
  %377 = icmp slt i64 %355, 0
  br i1 %377, label %435, label %387

378:
  %379 = phi i64 [ 0, %360 ], [ %385, %378 ]
  %380 = xor i64 %379, -1
  %381 = getelementptr <16 x float>, ptr %361, i64 %380
  %382 = load <16 x float>, ptr %381, align 4
  %383 = getelementptr inbounds <16 x float>, ptr %6, i64 %379
  %384 = load <16 x float>, ptr %383, align 4
  store <16 x float> %384, ptr %381, align 4
  store <16 x float> %382, ptr %383, align 4
  %385 = add nuw nsw i64 %379, 1
  %386 = icmp eq i64 %385, %358
  br i1 %386, label %375, label %378

387:
  %388 = phi i64 [ %412, %391 ], [ %355, %375 ]
  %389 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %388, ptr %7, align 8
  %390 = icmp eq i64 %389, 256
  br i1 %390, label %424, label %391

391:
  %392 = getelementptr <16 x float>, ptr %6, i64 %389
  %393 = getelementptr i8, ptr %392, i64 -64
  %394 = load <16 x float>, ptr %393, align 4
  %395 = getelementptr inbounds <16 x float>, ptr %25, i64 %388
  %396 = load <16 x float>, ptr %395, align 4
  %397 = fsub contract <16 x float> %396, %394
  %398 = load ptr, ptr %41, align 8
  %399 = load <16 x float>, ptr %398, align 4
  %400 = fcmp contract oeq <16 x float> %399, zeroinitializer
  %401 = select contract <16 x i1> %400, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %402 = fadd contract <16 x float> %399, %401
  %403 = fdiv contract <16 x float> %397, %402
  %404 = fadd contract <16 x float> %403, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %405 = fadd contract <16 x float> %404, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %406 = fmul contract <16 x float> %399, %405
  %407 = fsub contract <16 x float> %397, %406
  %408 = fadd contract <16 x float> %394, %407
  store <16 x float> %408, ptr %392, align 4
  %409 = add nuw nsw i64 %389, 1
  %410 = getelementptr inbounds i32, ptr %27, i64 %388
  %411 = load i32, ptr %410, align 4
  %412 = zext nneg i32 %411 to i64
  %413 = icmp slt i32 %411, 0
  br i1 %413, label %435, label %387

414:
  %415 = load i64, ptr %23, align 8
  %416 = icmp slt i64 %299, %415
  br i1 %416, label %417, label %427

417:
  %418 = fadd contract <16 x float> %302, %348
  %419 = getelementptr inbounds <16 x float>, ptr %231, i64 %299
  store <16 x float> %418, ptr %419, align 4
  %420 = trunc i64 %300 to i32
  %421 = load ptr, ptr %297, align 8
  %422 = add nsw i64 %299, 1
  store i64 %422, ptr %72, align 8
  %423 = getelementptr inbounds i32, ptr %421, i64 %299
  store i32 %420, ptr %423, align 4
  br label %424

424:
  %425 = phi i64 [ %422, %417 ], [ %299, %387 ]
  %426 = phi i64 [ %299, %417 ], [ %300, %387 ]
  br i1 %341, label %298, label %433

427:
  %428 = load i64, ptr %37, align 8
  br label %429

429:
  %430 = phi i64 [ %428, %427 ], [ %56, %216 ], [ %56, %213 ]
  %431 = add nuw nsw i64 %58, 1
  %432 = icmp slt i64 %431, %430
  br i1 %432, label %55, label %433

433:
  %434 = phi i64 [ 0, %31 ], [ -1, %362 ], [ -1, %424 ], [ 0, %429 ], [ 0, %71 ], [ 0, %55 ]
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  br label %440

435:
  %436 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %83, ptr %14, align 8
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  %437 = icmp sgt i64 %436, 2
  br i1 %437, label %438, label %440

438:
  %439 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %14, ptr noundef %6, i64 noundef %436)
  br label %440

440:
  %441 = phi i64 [ %439, %438 ], [ %436, %435 ], [ %434, %433 ]
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  ret i64 %441
}

define internal fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef nonnull readonly align 8 dereferenceable(96) %1, ptr nocapture noundef nonnull align 8 dereferenceable(8) %2, ptr nocapture noundef %3, i64 noundef %4) unnamed_addr {
  %6 = alloca <16 x float>, align 64
  %7 = alloca <16 x float>, align 64
  %8 = alloca <16 x float>, align 64
  %9 = alloca <16 x float>, align 64
  %10 = alloca [256 x float], align 16
  %11 = alloca float, align 4
  %12 = alloca float, align 4
  %13 = alloca i64, align 16
  %14 = alloca i64, align 8
  %15 = alloca <16 x float>, align 64
  %16 = alloca <16 x float>, align 64
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %10)
  %17 = icmp sgt i64 %4, 2
  br i1 %17, label %18, label %268

18:
  %19 = getelementptr inbounds i8, ptr %1, i64 84
  %20 = getelementptr inbounds i8, ptr %1, i64 88
  br label %21

21:
  %22 = phi i64 [ %4, %18 ], [ %66, %65 ]
  %23 = phi i64 [ 0, %18 ], [ %24, %65 ]
  %24 = add nuw nsw i64 %23, 1
  %25 = getelementptr inbounds <16 x float>, ptr %3, i64 %23
  %26 = load float, ptr %19, align 4
  %27 = load float, ptr %20, align 8
  br label %39

28:
  %29 = getelementptr inbounds i8, ptr %1, i64 56
  %30 = icmp sgt i64 %66, 2
  %31 = load i64, ptr %29, align 8
  %32 = icmp sgt i64 %31, 0
  %33 = select i1 %30, i1 %32, i1 false
  br i1 %33, label %34, label %268

34:
  %35 = getelementptr inbounds i8, ptr %1, i64 32
  %36 = getelementptr inbounds i8, ptr %1, i64 16
  %37 = getelementptr inbounds i8, ptr %1, i64 84
  %38 = getelementptr inbounds i8, ptr %1, i64 88
  br label %69

39:
  %40 = phi i64 [ %41, %43 ], [ %22, %21 ]
  %41 = add nsw i64 %40, -1
  %42 = icmp sgt i64 %41, %24
  br i1 %42, label %43, label %65

43:
  %44 = load <16 x float>, ptr %25, align 4
  %45 = getelementptr inbounds <16 x float>, ptr %3, i64 %41
  %46 = load <16 x float>, ptr %45, align 4
  %47 = fsub contract <16 x float> %46, %44
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %7)
  store <16 x float> %44, ptr %6, align 64
  store <16 x float> %47, ptr %7, align 64
  %48 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %6, ptr noundef nonnull %7, float noundef %26, float noundef %27)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %7)
  br i1 %48, label %49, label %39

49:
  %50 = sub i64 1, %40
  %51 = icmp sgt i64 %40, %22
  br i1 %51, label %55, label %52

52:
  %53 = getelementptr <16 x float>, ptr %3, i64 %50
  %54 = getelementptr <16 x float>, ptr %53, i64 %24
  br label %58

55:
  %56 = add i64 %22, %24
  %57 = add i64 %56, %50
  br label %65

58:
  %59 = phi i64 [ %41, %52 ], [ %63, %58 ]
  %60 = getelementptr inbounds <16 x float>, ptr %3, i64 %59
  %61 = load <16 x float>, ptr %60, align 4
  %62 = getelementptr <16 x float>, ptr %54, i64 %59
  store <16 x float> %61, ptr %62, align 4
  %63 = add nsw i64 %59, 1
  %64 = icmp eq i64 %63, %22
  br i1 %64, label %55, label %58

65:
  %66 = phi i64 [ %57, %55 ], [ %22, %39 ]
  %67 = add nuw nsw i64 %23, 3
  %68 = icmp slt i64 %67, %66
  br i1 %68, label %21, label %28

69:
  %70 = phi i64 [ %66, %34 ], [ %263, %261 ]
  %71 = phi i64 [ 0, %34 ], [ %262, %261 ]
  store float 0.000000e+00, ptr %10, align 16
  %72 = load i64, ptr %35, align 8
  %73 = icmp eq i64 %72, 0
  %74 = load ptr, ptr %36, align 8
  %75 = load <16 x float>, ptr %3, align 4
  %76 = load <16 x float>, ptr %74, align 4
  br label %105

77:
  %78 = add nsw i64 %70, -1
  %79 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %78
  %80 = load float, ptr %79, align 4
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %12)
  %81 = load i64, ptr %2, align 8
  %82 = add i64 %81, -7046029254386353131
  %83 = lshr i64 %82, 30
  %84 = xor i64 %83, %82
  %85 = mul i64 %84, -4658895280553007687
  %86 = lshr i64 %85, 27
  %87 = xor i64 %86, %85
  %88 = mul i64 %87, -7723592293110705685
  %89 = lshr i64 %88, 40
  %90 = uitofp nneg i64 %89 to float
  %91 = fmul contract float %90, 0x3E70000000000000
  %92 = fmul contract float %80, %91
  store float %92, ptr %11, align 4
  %93 = add i64 %81, 4354685564936845354
  store i64 %93, ptr %2, align 8
  %94 = lshr i64 %93, 30
  %95 = xor i64 %94, %93
  %96 = mul i64 %95, -4658895280553007687
  %97 = lshr i64 %96, 27
  %98 = xor i64 %97, %96
  %99 = mul i64 %98, -7723592293110705685
  %100 = lshr i64 %99, 40
  %101 = uitofp nneg i64 %100 to float
  %102 = fmul contract float %101, 0x3E70000000000000
  %103 = fmul contract float %80, %102
  store float %103, ptr %12, align 4
  %104 = fcmp contract ogt float %92, %103
  br i1 %104, label %138, label %139

105:
  %106 = phi <16 x float> [ %75, %69 ], [ %110, %132 ]
  %107 = phi float [ 0.000000e+00, %69 ], [ %134, %132 ]
  %108 = phi i64 [ 1, %69 ], [ %136, %132 ]
  %109 = getelementptr inbounds <16 x float>, ptr %3, i64 %108
  %110 = load <16 x float>, ptr %109, align 4
  %111 = fsub contract <16 x float> %110, %106
  %112 = fmul contract <16 x float> %111, %76
  br i1 %73, label %113, label %129

113:
  %114 = fmul contract <16 x float> %112, %112
  %115 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %116 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %117 = fadd contract <8 x float> %115, %116
  %118 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %119 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %120 = fadd contract <4 x float> %118, %119
  %121 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %122 = fadd contract <4 x float> %120, %121
  %123 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %124 = fadd contract <4 x float> %120, %123
  %125 = shufflevector <4 x float> %124, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %126 = fadd contract <4 x float> %122, %125
  %127 = extractelement <4 x float> %126, i64 0
  %128 = tail call contract float @llvm.sqrt.f32(float %127)
  br label %132

129:
  %130 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %112)
  %131 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %130)
  br label %132

132:
  %133 = phi float [ %131, %129 ], [ %128, %113 ]
  %134 = fadd contract float %107, %133
  %135 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %108
  store float %134, ptr %135, align 4
  %136 = add nuw nsw i64 %108, 1
  %137 = icmp eq i64 %136, %70
  br i1 %137, label %77, label %105

138:
  store float %103, ptr %11, align 4
  store float %92, ptr %12, align 4
  br label %139

139:
  %140 = phi float [ %103, %138 ], [ %92, %77 ]
  %141 = phi float [ %92, %138 ], [ %103, %77 ]
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %16)
  %142 = add nsw i64 %70, -2
  %143 = add nsw i64 %70, -1
  %144 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %143
  br label %145

145:
  %146 = phi i1 [ true, %139 ], [ false, %213 ]
  %147 = phi ptr [ %15, %139 ], [ %16, %213 ]
  %148 = phi ptr [ %13, %139 ], [ %14, %213 ]
  %149 = phi ptr [ %11, %139 ], [ %12, %213 ]
  br label %190

150:
  %151 = fsub contract float %141, %140
  %152 = load <16 x float>, ptr %16, align 64
  %153 = load <16 x float>, ptr %15, align 64
  %154 = fsub contract <16 x float> %152, %153
  %155 = load i64, ptr %35, align 8
  %156 = icmp eq i64 %155, 0
  %157 = load ptr, ptr %36, align 8
  %158 = load <16 x float>, ptr %157, align 4
  %159 = fmul contract <16 x float> %154, %158
  br i1 %156, label %160, label %176

160:
  %161 = fmul contract <16 x float> %159, %159
  %162 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %163 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %164 = fadd contract <8 x float> %162, %163
  %165 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %166 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %167 = fadd contract <4 x float> %165, %166
  %168 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %167, %170
  %172 = shufflevector <4 x float> %171, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = extractelement <4 x float> %173, i64 0
  %175 = tail call contract float @llvm.sqrt.f32(float %174)
  br label %179

176:
  %177 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %159)
  %178 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %177)
  br label %179

179:
  %180 = phi float [ %178, %176 ], [ %175, %160 ]
  %181 = fsub contract float %151, %180
  %182 = load i64, ptr %13, align 16
  %183 = load i64, ptr %14, align 8
  %184 = icmp eq i64 %182, %183
  %185 = fmul contract float %80, 0x3F1A36E2E0000000
  %186 = fcmp contract olt float %181, %185
  %187 = select i1 %184, i1 true, i1 %186
  %188 = icmp sgt i64 %70, 254
  %189 = or i1 %188, %187
  br i1 %189, label %228, label %224

190:
  %191 = phi i64 [ %196, %195 ], [ 0, %145 ]
  %192 = icmp eq i64 %191, %142
  br i1 %192, label %193, label %195

193:
  %194 = load float, ptr %144, align 4
  br label %201

195:
  %196 = add nuw nsw i64 %191, 1
  %197 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %196
  %198 = load float, ptr %197, align 4
  %199 = load float, ptr %149, align 4
  %200 = fcmp contract olt float %198, %199
  br i1 %200, label %190, label %201

201:
  %202 = phi float [ %194, %193 ], [ %198, %195 ]
  %203 = phi i64 [ %143, %193 ], [ %196, %195 ]
  %204 = phi i64 [ %142, %193 ], [ %191, %195 ]
  %205 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %204
  %206 = load float, ptr %205, align 4
  %207 = fsub contract float %202, %206
  %208 = fcmp contract ogt float %207, 0.000000e+00
  br i1 %208, label %209, label %213

209:
  %210 = load float, ptr %149, align 4
  %211 = fsub contract float %210, %206
  %212 = fdiv contract float %211, %207
  br label %213

213:
  %214 = phi contract float [ %212, %209 ], [ 0.000000e+00, %201 ]
  %215 = getelementptr inbounds <16 x float>, ptr %3, i64 %204
  %216 = load <16 x float>, ptr %215, align 4
  %217 = insertelement <16 x float> poison, float %214, i64 0
  %218 = shufflevector <16 x float> %217, <16 x float> poison, <16 x i32> zeroinitializer
  %219 = getelementptr inbounds <16 x float>, ptr %3, i64 %203
  %220 = load <16 x float>, ptr %219, align 4
  %221 = fsub contract <16 x float> %220, %216
  %222 = fmul contract <16 x float> %218, %221
  %223 = fadd contract <16 x float> %216, %222
  store <16 x float> %223, ptr %147, align 64
  store i64 %204, ptr %148, align 8
  br i1 %146, label %145, label %150

224:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  store <16 x float> %153, ptr %8, align 64
  store <16 x float> %154, ptr %9, align 64
  %225 = load float, ptr %37, align 4
  %226 = load float, ptr %38, align 8
  %227 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %8, ptr noundef nonnull %9, float noundef %225, float noundef %226)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  br i1 %227, label %230, label %228

228:
  %229 = add nsw i64 %71, 1
  br label %261

230:
  %231 = fmul contract float %80, 0x3F847AE140000000
  %232 = fcmp contract ogt float %181, %231
  %233 = select i1 %232, i64 0, i64 %71
  %234 = sub i64 %182, %183
  %235 = add i64 %234, 2
  %236 = icmp sgt i64 %235, 0
  br i1 %236, label %240, label %237

237:
  %238 = add nsw i64 %183, 1
  %239 = icmp slt i64 %238, %70
  br i1 %239, label %249, label %256

240:
  %241 = icmp sgt i64 %78, %183
  br i1 %241, label %242, label %256

242:
  %243 = phi i64 [ %247, %242 ], [ %78, %240 ]
  %244 = getelementptr inbounds <16 x float>, ptr %3, i64 %243
  %245 = load <16 x float>, ptr %244, align 4
  %246 = getelementptr <16 x float>, ptr %244, i64 %235
  store <16 x float> %245, ptr %246, align 4
  %247 = add nsw i64 %243, -1
  %248 = icmp sgt i64 %247, %183
  br i1 %248, label %242, label %256

249:
  %250 = phi i64 [ %254, %249 ], [ %238, %237 ]
  %251 = getelementptr inbounds <16 x float>, ptr %3, i64 %250
  %252 = load <16 x float>, ptr %251, align 4
  %253 = getelementptr <16 x float>, ptr %251, i64 %235
  store <16 x float> %252, ptr %253, align 4
  %254 = add nsw i64 %250, 1
  %255 = icmp eq i64 %254, %70
  br i1 %255, label %256, label %249

256:
  %257 = getelementptr <16 x float>, ptr %3, i64 %182
  %258 = getelementptr i8, ptr %257, i64 64
  store <16 x float> %153, ptr %258, align 4
  %259 = getelementptr i8, ptr %257, i64 128
  store <16 x float> %152, ptr %259, align 4
  %260 = add nsw i64 %235, %70
  br label %261

261:
  %262 = phi i64 [ %229, %228 ], [ %233, %256 ]
  %263 = phi i64 [ %70, %228 ], [ %260, %256 ]
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %16)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %12)
  %264 = icmp sgt i64 %263, 2
  %265 = load i64, ptr %29, align 8
  %266 = icmp slt i64 %262, %265
  %267 = select i1 %264, i1 %266, i1 false
  br i1 %267, label %69, label %268

268:
  %269 = phi i64 [ %66, %28 ], [ %4, %5 ], [ %263, %261 ]
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %10)
  ret i64 %269
}

define noundef i64 @shorten(ptr nocapture noundef nonnull readonly %0, ptr nocapture noundef nonnull readonly %1, ptr nocapture noundef %2, i64 noundef %3, i64 noundef %4) {
  %6 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %6)
  store i64 %4, ptr %6, align 8
  %7 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %6, ptr noundef %2, i64 noundef %3)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %6)
  ret i64 %7
}

declare <16 x float> @llvm.fabs.v16f32(<16 x float>)

declare <16 x float> @llvm.sqrt.v16f32(<16 x float>)

declare <8 x double> @llvm.fabs.v8f64(<8 x double>)

declare <8 x double> @llvm.sqrt.v8f64(<8 x double>)

define linkonce_odr void @_ZN6Errors8evaluateILb0EEEvRK8ManifoldPKDv8_d(ptr noundef nonnull align 64 dereferenceable(103168) %0, ptr noundef nonnull align 8 dereferenceable(104) %1, ptr noundef %2) comdat align 2 {
  %4 = alloca [9 x <8 x double>], align 64
  %5 = alloca [65 x %struct.Frame.3], align 64
  %6 = load i64, ptr %1, align 8
  call void @llvm.lifetime.start.p0(i64 49920, ptr nonnull %5)
  %7 = getelementptr inbounds i8, ptr %1, i64 24
  %8 = load ptr, ptr %7, align 8
  br label %11

9:
  %10 = getelementptr inbounds i8, ptr %5, i64 576
  br label %23

11:
  %12 = phi i64 [ 0, %3 ], [ %19, %11 ]
  %13 = and i64 %12, 3
  %14 = icmp eq i64 %13, 0
  %15 = uitofp i1 %14 to double
  %16 = insertelement <8 x double> poison, double %15, i64 0
  %17 = shufflevector <8 x double> %16, <8 x double> poison, <8 x i32> zeroinitializer
  %18 = getelementptr inbounds [9 x <8 x double>], ptr %5, i64 0, i64 %12
  store <8 x double> %17, ptr %18, align 64
  %19 = add nuw nsw i64 %12, 1
  %20 = icmp eq i64 %19, 9
  br i1 %20, label %9, label %11

21:
  %22 = icmp sgt i64 %6, 0
  br i1 %22, label %28, label %232

23:
  %24 = phi i64 [ 0, %9 ], [ %26, %23 ]
  %25 = getelementptr inbounds [3 x <8 x double>], ptr %10, i64 0, i64 %24
  store <8 x double> zeroinitializer, ptr %25, align 64
  %26 = add nuw nsw i64 %24, 1
  %27 = icmp eq i64 %26, 3
  br i1 %27, label %21, label %23

28:
  %29 = phi i64 [ %32, %230 ], [ 0, %21 ]
  %30 = getelementptr inbounds %struct.Joint.6, ptr %8, i64 %29
  %31 = getelementptr inbounds %struct.Frame.3, ptr %5, i64 %29
  %32 = add nuw nsw i64 %29, 1
  %33 = getelementptr inbounds <8 x double>, ptr %2, i64 %29
  %34 = load <8 x double>, ptr %33, align 64
  %35 = getelementptr inbounds i8, ptr %30, i64 72
  %36 = load double, ptr %35, align 8
  %37 = getelementptr inbounds i8, ptr %30, i64 80
  %38 = load double, ptr %37, align 8
  %39 = getelementptr inbounds i8, ptr %30, i64 88
  %40 = load double, ptr %39, align 8
  %41 = getelementptr inbounds i8, ptr %31, i64 576
  %42 = load <8 x double>, ptr %41, align 64
  %43 = load <8 x double>, ptr %31, align 64
  %44 = insertelement <8 x double> poison, double %36, i64 0
  %45 = shufflevector <8 x double> %44, <8 x double> poison, <8 x i32> zeroinitializer
  %46 = fmul contract <8 x double> %45, %43
  %47 = getelementptr inbounds i8, ptr %31, i64 64
  %48 = load <8 x double>, ptr %47, align 64
  %49 = insertelement <8 x double> poison, double %38, i64 0
  %50 = shufflevector <8 x double> %49, <8 x double> poison, <8 x i32> zeroinitializer
  %51 = fmul contract <8 x double> %50, %48
  %52 = getelementptr inbounds i8, ptr %31, i64 128
  %53 = load <8 x double>, ptr %52, align 64
  %54 = insertelement <8 x double> poison, double %40, i64 0
  %55 = shufflevector <8 x double> %54, <8 x double> poison, <8 x i32> zeroinitializer
  %56 = fmul contract <8 x double> %55, %53
  %57 = getelementptr inbounds i8, ptr %31, i64 640
  %58 = load <8 x double>, ptr %57, align 64
  %59 = getelementptr inbounds i8, ptr %31, i64 192
  %60 = load <8 x double>, ptr %59, align 64
  %61 = fmul contract <8 x double> %45, %60
  %62 = getelementptr inbounds i8, ptr %31, i64 256
  %63 = load <8 x double>, ptr %62, align 64
  %64 = fmul contract <8 x double> %50, %63
  %65 = getelementptr inbounds i8, ptr %31, i64 320
  %66 = load <8 x double>, ptr %65, align 64
  %67 = fmul contract <8 x double> %55, %66
  %68 = getelementptr inbounds i8, ptr %31, i64 704
  %69 = load <8 x double>, ptr %68, align 64
  %70 = getelementptr inbounds i8, ptr %31, i64 384
  %71 = load <8 x double>, ptr %70, align 64
  %72 = fmul contract <8 x double> %45, %71
  %73 = getelementptr inbounds i8, ptr %31, i64 448
  %74 = load <8 x double>, ptr %73, align 64
  %75 = fmul contract <8 x double> %50, %74
  %76 = getelementptr inbounds i8, ptr %31, i64 512
  %77 = load <8 x double>, ptr %76, align 64
  %78 = fmul contract <8 x double> %55, %77
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %4)
  br label %79

79:
  %80 = phi i64 [ 0, %28 ], [ %108, %107 ]
  %81 = mul nuw nsw i64 %80, 3
  %82 = getelementptr inbounds [9 x <8 x double>], ptr %31, i64 0, i64 %81
  %83 = load <8 x double>, ptr %82, align 64
  %84 = add nuw nsw i64 %81, 1
  %85 = getelementptr inbounds [9 x <8 x double>], ptr %31, i64 0, i64 %84
  %86 = load <8 x double>, ptr %85, align 64
  %87 = add nuw nsw i64 %81, 2
  %88 = getelementptr inbounds [9 x <8 x double>], ptr %31, i64 0, i64 %87
  %89 = load <8 x double>, ptr %88, align 64
  br label %110

90:
  %91 = getelementptr inbounds %struct.Frame.3, ptr %5, i64 %32
  %92 = fadd contract <8 x double> %42, %46
  %93 = fadd contract <8 x double> %92, %51
  %94 = fadd contract <8 x double> %93, %56
  %95 = fadd contract <8 x double> %58, %61
  %96 = fadd contract <8 x double> %95, %64
  %97 = fadd contract <8 x double> %96, %67
  %98 = fadd contract <8 x double> %69, %72
  %99 = fadd contract <8 x double> %98, %75
  %100 = fadd contract <8 x double> %99, %78
  %101 = getelementptr inbounds i8, ptr %91, i64 576
  store <8 x double> %94, ptr %101, align 64
  %102 = getelementptr inbounds i8, ptr %91, i64 640
  store <8 x double> %97, ptr %102, align 64
  %103 = getelementptr inbounds i8, ptr %91, i64 704
  store <8 x double> %100, ptr %103, align 64
  %104 = getelementptr inbounds i8, ptr %30, i64 96
  %105 = load double, ptr %104, align 8
  %106 = fcmp contract une double %105, 0.000000e+00
  br i1 %106, label %135, label %154

107:
  %108 = add nuw nsw i64 %80, 1
  %109 = icmp eq i64 %108, 3
  br i1 %109, label %90, label %79

110:
  %111 = phi i64 [ 0, %79 ], [ %133, %110 ]
  %112 = getelementptr inbounds [9 x double], ptr %30, i64 0, i64 %111
  %113 = load double, ptr %112, align 8
  %114 = insertelement <8 x double> poison, double %113, i64 0
  %115 = shufflevector <8 x double> %114, <8 x double> poison, <8 x i32> zeroinitializer
  %116 = fmul contract <8 x double> %83, %115
  %117 = add nuw nsw i64 %111, 3
  %118 = getelementptr inbounds [9 x double], ptr %30, i64 0, i64 %117
  %119 = load double, ptr %118, align 8
  %120 = insertelement <8 x double> poison, double %119, i64 0
  %121 = shufflevector <8 x double> %120, <8 x double> poison, <8 x i32> zeroinitializer
  %122 = fmul contract <8 x double> %86, %121
  %123 = fadd contract <8 x double> %116, %122
  %124 = add nuw nsw i64 %111, 6
  %125 = getelementptr inbounds [9 x double], ptr %30, i64 0, i64 %124
  %126 = load double, ptr %125, align 8
  %127 = insertelement <8 x double> poison, double %126, i64 0
  %128 = shufflevector <8 x double> %127, <8 x double> poison, <8 x i32> zeroinitializer
  %129 = fmul contract <8 x double> %89, %128
  %130 = fadd contract <8 x double> %123, %129
  %131 = add nuw nsw i64 %111, %81
  %132 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %131
  store <8 x double> %130, ptr %132, align 64
  %133 = add nuw nsw i64 %111, 1
  %134 = icmp eq i64 %133, 3
  br i1 %134, label %107, label %110

135:
  %136 = phi i64 [ %140, %135 ], [ 0, %90 ]
  %137 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %136
  %138 = load <8 x double>, ptr %137, align 64
  %139 = getelementptr inbounds [9 x <8 x double>], ptr %91, i64 0, i64 %136
  store <8 x double> %138, ptr %139, align 64
  %140 = add nuw nsw i64 %136, 1
  %141 = icmp eq i64 %140, 9
  br i1 %141, label %142, label %135

142:
  %143 = phi i64 [ %152, %142 ], [ 0, %135 ]
  %144 = mul nuw nsw i64 %143, 3
  %145 = add nuw nsw i64 %144, 2
  %146 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %145
  %147 = load <8 x double>, ptr %146, align 64
  %148 = fmul contract <8 x double> %34, %147
  %149 = getelementptr inbounds [3 x <8 x double>], ptr %101, i64 0, i64 %143
  %150 = load <8 x double>, ptr %149, align 64
  %151 = fadd contract <8 x double> %150, %148
  store <8 x double> %151, ptr %149, align 64
  %152 = add nuw nsw i64 %143, 1
  %153 = icmp eq i64 %152, 3
  br i1 %153, label %230, label %142

154:
  %155 = fmul contract <8 x double> %34, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %156 = fadd contract <8 x double> %155, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %157 = fadd contract <8 x double> %156, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %158 = fmul contract <8 x double> %157, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %159 = fsub contract <8 x double> %34, %158
  %160 = fmul contract <8 x double> %157, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %161 = fsub contract <8 x double> %159, %160
  %162 = fmul contract <8 x double> %157, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %163 = fsub contract <8 x double> %161, %162
  %164 = fmul contract <8 x double> %157, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %165 = fadd contract <8 x double> %164, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %166 = fadd contract <8 x double> %165, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %167 = fsub contract <8 x double> %164, %166
  %168 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %167)
  %169 = fmul contract <8 x double> %168, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %170 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %169
  %171 = fmul contract <8 x double> %163, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %172 = fmul contract <8 x double> %171, %171
  %173 = fmul contract <8 x double> %171, %172
  %174 = fmul contract <8 x double> %172, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %175 = fadd contract <8 x double> %174, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %176 = fmul contract <8 x double> %172, %175
  %177 = fadd contract <8 x double> %176, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %178 = fmul contract <8 x double> %172, %177
  %179 = fadd contract <8 x double> %178, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %180 = fmul contract <8 x double> %172, %179
  %181 = fadd contract <8 x double> %180, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %182 = fmul contract <8 x double> %172, %181
  %183 = fadd contract <8 x double> %182, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %184 = fmul contract <8 x double> %173, %183
  %185 = fadd contract <8 x double> %171, %184
  %186 = fmul contract <8 x double> %172, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %187 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %186
  %188 = fmul contract <8 x double> %172, %172
  %189 = fmul contract <8 x double> %172, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %190 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %189
  %191 = fmul contract <8 x double> %172, %190
  %192 = fadd contract <8 x double> %191, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %193 = fmul contract <8 x double> %172, %192
  %194 = fadd contract <8 x double> %193, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %195 = fmul contract <8 x double> %172, %194
  %196 = fadd contract <8 x double> %195, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %197 = fmul contract <8 x double> %172, %196
  %198 = fadd contract <8 x double> %197, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %199 = fmul contract <8 x double> %188, %198
  %200 = fadd contract <8 x double> %187, %199
  %201 = fmul contract <8 x double> %170, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %202 = fmul contract <8 x double> %201, %185
  %203 = fmul contract <8 x double> %200, %202
  %204 = fmul contract <8 x double> %185, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %205 = fmul contract <8 x double> %185, %204
  %206 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %205
  %207 = fmul contract <8 x double> %170, %206
  br label %208

208:
  %209 = phi i64 [ 0, %154 ], [ %228, %208 ]
  %210 = mul nuw nsw i64 %209, 3
  %211 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %210
  %212 = load <8 x double>, ptr %211, align 64
  %213 = fmul contract <8 x double> %207, %212
  %214 = add nuw nsw i64 %210, 1
  %215 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %214
  %216 = load <8 x double>, ptr %215, align 64
  %217 = fmul contract <8 x double> %203, %216
  %218 = fadd contract <8 x double> %213, %217
  %219 = getelementptr inbounds [9 x <8 x double>], ptr %91, i64 0, i64 %210
  store <8 x double> %218, ptr %219, align 64
  %220 = fmul contract <8 x double> %207, %216
  %221 = fmul contract <8 x double> %203, %212
  %222 = fsub contract <8 x double> %220, %221
  %223 = getelementptr inbounds [9 x <8 x double>], ptr %91, i64 0, i64 %214
  store <8 x double> %222, ptr %223, align 64
  %224 = add nuw nsw i64 %210, 2
  %225 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %224
  %226 = load <8 x double>, ptr %225, align 64
  %227 = getelementptr inbounds [9 x <8 x double>], ptr %91, i64 0, i64 %224
  store <8 x double> %226, ptr %227, align 64
  %228 = add nuw nsw i64 %209, 1
  %229 = icmp eq i64 %228, 3
  br i1 %229, label %230, label %208

230:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %4)
  %231 = icmp eq i64 %32, %6
  br i1 %231, label %232, label %28

232:
  %233 = getelementptr inbounds i8, ptr %1, i64 40
  %234 = load ptr, ptr %233, align 8
  %235 = getelementptr inbounds [65 x %struct.Frame.3], ptr %5, i64 0, i64 %6
  %236 = getelementptr inbounds i8, ptr %234, i64 72
  %237 = load double, ptr %236, align 8
  %238 = getelementptr inbounds i8, ptr %234, i64 80
  %239 = load double, ptr %238, align 8
  %240 = getelementptr inbounds i8, ptr %234, i64 88
  %241 = load double, ptr %240, align 8
  %242 = getelementptr inbounds i8, ptr %235, i64 576
  %243 = load <8 x double>, ptr %242, align 64
  %244 = load <8 x double>, ptr %235, align 64
  %245 = insertelement <8 x double> poison, double %237, i64 0
  %246 = shufflevector <8 x double> %245, <8 x double> poison, <8 x i32> zeroinitializer
  %247 = fmul contract <8 x double> %246, %244
  %248 = fadd contract <8 x double> %243, %247
  %249 = getelementptr inbounds i8, ptr %235, i64 64
  %250 = load <8 x double>, ptr %249, align 64
  %251 = insertelement <8 x double> poison, double %239, i64 0
  %252 = shufflevector <8 x double> %251, <8 x double> poison, <8 x i32> zeroinitializer
  %253 = fmul contract <8 x double> %252, %250
  %254 = fadd contract <8 x double> %248, %253
  %255 = getelementptr inbounds i8, ptr %235, i64 128
  %256 = load <8 x double>, ptr %255, align 64
  %257 = insertelement <8 x double> poison, double %241, i64 0
  %258 = shufflevector <8 x double> %257, <8 x double> poison, <8 x i32> zeroinitializer
  %259 = fmul contract <8 x double> %258, %256
  %260 = fadd contract <8 x double> %254, %259
  %261 = getelementptr inbounds i8, ptr %235, i64 640
  %262 = load <8 x double>, ptr %261, align 64
  %263 = getelementptr inbounds i8, ptr %235, i64 192
  %264 = load <8 x double>, ptr %263, align 64
  %265 = fmul contract <8 x double> %246, %264
  %266 = fadd contract <8 x double> %262, %265
  %267 = getelementptr inbounds i8, ptr %235, i64 256
  %268 = load <8 x double>, ptr %267, align 64
  %269 = fmul contract <8 x double> %252, %268
  %270 = fadd contract <8 x double> %266, %269
  %271 = getelementptr inbounds i8, ptr %235, i64 320
  %272 = load <8 x double>, ptr %271, align 64
  %273 = fmul contract <8 x double> %258, %272
  %274 = fadd contract <8 x double> %270, %273
  %275 = getelementptr inbounds i8, ptr %235, i64 704
  %276 = load <8 x double>, ptr %275, align 64
  %277 = getelementptr inbounds i8, ptr %235, i64 384
  %278 = load <8 x double>, ptr %277, align 64
  %279 = fmul contract <8 x double> %246, %278
  %280 = fadd contract <8 x double> %276, %279
  %281 = getelementptr inbounds i8, ptr %235, i64 448
  %282 = load <8 x double>, ptr %281, align 64
  %283 = fmul contract <8 x double> %252, %282
  %284 = fadd contract <8 x double> %280, %283
  %285 = getelementptr inbounds i8, ptr %235, i64 512
  %286 = load <8 x double>, ptr %285, align 64
  %287 = fmul contract <8 x double> %258, %286
  %288 = fadd contract <8 x double> %284, %287
  store i64 0, ptr %0, align 64
  %289 = getelementptr inbounds i8, ptr %1, i64 8
  %290 = load i64, ptr %289, align 8
  %291 = icmp sgt i64 %290, 0
  br i1 %291, label %292, label %297

292:
  %293 = getelementptr inbounds i8, ptr %1, i64 32
  %294 = getelementptr inbounds i8, ptr %0, i64 101632
  %295 = getelementptr inbounds i8, ptr %0, i64 8
  %296 = getelementptr inbounds i8, ptr %0, i64 256
  br label %298

297:
  call void @llvm.lifetime.end.p0(i64 49920, ptr nonnull %5)
  ret void

298:
  %299 = phi i64 [ 0, %292 ], [ %507, %506 ]
  %300 = phi i64 [ 0, %292 ], [ %508, %506 ]
  %301 = load ptr, ptr %293, align 8
  %302 = getelementptr inbounds %struct.Constraint, ptr %301, i64 %300
  %303 = load i64, ptr %302, align 8
  %304 = icmp eq i64 %303, 0
  br i1 %304, label %357, label %305

305:
  %306 = icmp sgt i64 %303, 0
  br i1 %306, label %307, label %324

307:
  %308 = getelementptr inbounds i8, ptr %302, i64 24
  %309 = getelementptr inbounds i8, ptr %302, i64 96
  %310 = load double, ptr %309, align 8
  %311 = insertelement <8 x double> poison, double %310, i64 0
  %312 = shufflevector <8 x double> %311, <8 x double> poison, <8 x i32> zeroinitializer
  %313 = fsub contract <8 x double> %312, %260
  %314 = getelementptr inbounds i8, ptr %302, i64 104
  %315 = load double, ptr %314, align 8
  %316 = insertelement <8 x double> poison, double %315, i64 0
  %317 = shufflevector <8 x double> %316, <8 x double> poison, <8 x i32> zeroinitializer
  %318 = fsub contract <8 x double> %317, %274
  %319 = getelementptr inbounds i8, ptr %302, i64 112
  %320 = load double, ptr %319, align 8
  %321 = insertelement <8 x double> poison, double %320, i64 0
  %322 = shufflevector <8 x double> %321, <8 x double> poison, <8 x i32> zeroinitializer
  %323 = fsub contract <8 x double> %322, %288
  br label %332

324:
  %325 = phi <8 x double> [ zeroinitializer, %305 ], [ %354, %332 ]
  %326 = getelementptr inbounds [24 x <8 x double>], ptr %294, i64 0, i64 %299
  store <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, ptr %326, align 64
  %327 = load i64, ptr %0, align 64
  %328 = getelementptr inbounds [24 x i64], ptr %295, i64 0, i64 %299
  store i64 %327, ptr %328, align 8
  %329 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %325)
  %330 = add nsw i64 %299, 1
  %331 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %299
  store <8 x double> %329, ptr %331, align 64
  br label %357

332:
  %333 = phi <8 x double> [ zeroinitializer, %307 ], [ %354, %332 ]
  %334 = phi i64 [ 0, %307 ], [ %355, %332 ]
  %335 = mul i64 %334, 24
  %336 = getelementptr inbounds i8, ptr %308, i64 %335
  %337 = load double, ptr %336, align 8
  %338 = insertelement <8 x double> poison, double %337, i64 0
  %339 = shufflevector <8 x double> %338, <8 x double> poison, <8 x i32> zeroinitializer
  %340 = fmul contract <8 x double> %313, %339
  %341 = getelementptr inbounds i8, ptr %336, i64 8
  %342 = load double, ptr %341, align 8
  %343 = insertelement <8 x double> poison, double %342, i64 0
  %344 = shufflevector <8 x double> %343, <8 x double> poison, <8 x i32> zeroinitializer
  %345 = fmul contract <8 x double> %318, %344
  %346 = fadd contract <8 x double> %340, %345
  %347 = getelementptr inbounds i8, ptr %336, i64 16
  %348 = load double, ptr %347, align 8
  %349 = insertelement <8 x double> poison, double %348, i64 0
  %350 = shufflevector <8 x double> %349, <8 x double> poison, <8 x i32> zeroinitializer
  %351 = fmul contract <8 x double> %323, %350
  %352 = fadd contract <8 x double> %346, %351
  %353 = fmul contract <8 x double> %352, %352
  %354 = fadd contract <8 x double> %333, %353
  %355 = add nuw nsw i64 %334, 1
  %356 = icmp eq i64 %355, %303
  br i1 %356, label %324, label %332

357:
  %358 = phi i64 [ %330, %324 ], [ %299, %298 ]
  %359 = getelementptr inbounds i8, ptr %302, i64 8
  %360 = load i64, ptr %359, align 8
  %361 = icmp eq i64 %360, 0
  br i1 %361, label %431, label %362

362:
  %363 = getelementptr inbounds i8, ptr %302, i64 120
  br label %378

364:
  %365 = fmul contract <8 x double> %428, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %366 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %365)
  %367 = fmul contract <8 x double> %366, <double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01>
  %368 = fmul contract <8 x double> %366, %367
  %369 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %368
  %370 = fcmp contract ogt <8 x double> %369, zeroinitializer
  %371 = select contract <8 x i1> %370, <8 x double> %369, <8 x double> zeroinitializer
  %372 = fmul contract <8 x double> %371, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %373 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %372)
  %374 = getelementptr inbounds [24 x <8 x double>], ptr %294, i64 0, i64 %358
  store <8 x double> %373, ptr %374, align 64
  %375 = load i64, ptr %0, align 64
  %376 = getelementptr inbounds [24 x i64], ptr %295, i64 0, i64 %358
  store i64 %375, ptr %376, align 8
  %377 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %428)
  br label %502

378:
  %379 = phi <8 x double> [ zeroinitializer, %362 ], [ %428, %378 ]
  %380 = phi i64 [ 0, %362 ], [ %429, %378 ]
  %381 = getelementptr inbounds double, ptr %234, i64 %380
  %382 = load double, ptr %381, align 8
  %383 = getelementptr inbounds i8, ptr %381, i64 24
  %384 = load double, ptr %383, align 8
  %385 = getelementptr inbounds i8, ptr %381, i64 48
  %386 = load double, ptr %385, align 8
  %387 = insertelement <8 x double> poison, double %382, i64 0
  %388 = shufflevector <8 x double> %387, <8 x double> poison, <8 x i32> zeroinitializer
  %389 = fmul contract <8 x double> %244, %388
  %390 = insertelement <8 x double> poison, double %384, i64 0
  %391 = shufflevector <8 x double> %390, <8 x double> poison, <8 x i32> zeroinitializer
  %392 = fmul contract <8 x double> %250, %391
  %393 = fadd contract <8 x double> %389, %392
  %394 = insertelement <8 x double> poison, double %386, i64 0
  %395 = shufflevector <8 x double> %394, <8 x double> poison, <8 x i32> zeroinitializer
  %396 = fmul contract <8 x double> %256, %395
  %397 = fadd contract <8 x double> %393, %396
  %398 = fmul contract <8 x double> %264, %388
  %399 = fmul contract <8 x double> %268, %391
  %400 = fadd contract <8 x double> %398, %399
  %401 = fmul contract <8 x double> %272, %395
  %402 = fadd contract <8 x double> %400, %401
  %403 = fmul contract <8 x double> %278, %388
  %404 = fmul contract <8 x double> %282, %391
  %405 = fadd contract <8 x double> %403, %404
  %406 = fmul contract <8 x double> %286, %395
  %407 = fadd contract <8 x double> %405, %406
  %408 = getelementptr inbounds double, ptr %363, i64 %380
  %409 = load double, ptr %408, align 8
  %410 = insertelement <8 x double> poison, double %409, i64 0
  %411 = shufflevector <8 x double> %410, <8 x double> poison, <8 x i32> zeroinitializer
  %412 = fsub contract <8 x double> %397, %411
  %413 = getelementptr inbounds i8, ptr %408, i64 24
  %414 = load double, ptr %413, align 8
  %415 = insertelement <8 x double> poison, double %414, i64 0
  %416 = shufflevector <8 x double> %415, <8 x double> poison, <8 x i32> zeroinitializer
  %417 = fsub contract <8 x double> %402, %416
  %418 = getelementptr inbounds i8, ptr %408, i64 48
  %419 = load double, ptr %418, align 8
  %420 = insertelement <8 x double> poison, double %419, i64 0
  %421 = shufflevector <8 x double> %420, <8 x double> poison, <8 x i32> zeroinitializer
  %422 = fsub contract <8 x double> %407, %421
  %423 = fmul contract <8 x double> %412, %412
  %424 = fmul contract <8 x double> %417, %417
  %425 = fadd contract <8 x double> %423, %424
  %426 = fmul contract <8 x double> %422, %422
  %427 = fadd contract <8 x double> %425, %426
  %428 = fadd contract <8 x double> %379, %427
  %429 = add nuw nsw i64 %380, 1
  %430 = icmp eq i64 %429, 3
  br i1 %430, label %364, label %378

431:
  %432 = getelementptr inbounds i8, ptr %302, i64 16
  %433 = load i64, ptr %432, align 8
  %434 = icmp eq i64 %433, 0
  br i1 %434, label %506, label %435

435:
  %436 = getelementptr inbounds i8, ptr %302, i64 192
  %437 = getelementptr inbounds i8, ptr %302, i64 216
  %438 = load double, ptr %437, align 8
  %439 = insertelement <8 x double> poison, double %438, i64 0
  %440 = shufflevector <8 x double> %439, <8 x double> poison, <8 x i32> zeroinitializer
  %441 = fmul contract <8 x double> %244, %440
  %442 = getelementptr inbounds i8, ptr %302, i64 224
  %443 = load double, ptr %442, align 8
  %444 = insertelement <8 x double> poison, double %443, i64 0
  %445 = shufflevector <8 x double> %444, <8 x double> poison, <8 x i32> zeroinitializer
  %446 = fmul contract <8 x double> %250, %445
  %447 = fadd contract <8 x double> %441, %446
  %448 = getelementptr inbounds i8, ptr %302, i64 232
  %449 = load double, ptr %448, align 8
  %450 = insertelement <8 x double> poison, double %449, i64 0
  %451 = shufflevector <8 x double> %450, <8 x double> poison, <8 x i32> zeroinitializer
  %452 = fmul contract <8 x double> %256, %451
  %453 = fadd contract <8 x double> %447, %452
  %454 = fmul contract <8 x double> %264, %440
  %455 = fmul contract <8 x double> %268, %445
  %456 = fadd contract <8 x double> %454, %455
  %457 = fmul contract <8 x double> %272, %451
  %458 = fadd contract <8 x double> %456, %457
  %459 = fmul contract <8 x double> %278, %440
  %460 = fmul contract <8 x double> %282, %445
  %461 = fadd contract <8 x double> %459, %460
  %462 = fmul contract <8 x double> %286, %451
  %463 = fadd contract <8 x double> %461, %462
  %464 = getelementptr inbounds i8, ptr %302, i64 208
  %465 = load double, ptr %464, align 8
  %466 = insertelement <8 x double> poison, double %465, i64 0
  %467 = shufflevector <8 x double> %466, <8 x double> poison, <8 x i32> zeroinitializer
  %468 = fmul contract <8 x double> %467, %458
  %469 = getelementptr inbounds i8, ptr %302, i64 200
  %470 = load double, ptr %469, align 8
  %471 = insertelement <8 x double> poison, double %470, i64 0
  %472 = shufflevector <8 x double> %471, <8 x double> poison, <8 x i32> zeroinitializer
  %473 = fmul contract <8 x double> %463, %472
  %474 = fsub contract <8 x double> %468, %473
  %475 = load double, ptr %436, align 8
  %476 = insertelement <8 x double> poison, double %475, i64 0
  %477 = shufflevector <8 x double> %476, <8 x double> poison, <8 x i32> zeroinitializer
  %478 = fmul contract <8 x double> %463, %477
  %479 = fmul contract <8 x double> %467, %453
  %480 = fsub contract <8 x double> %478, %479
  %481 = fmul contract <8 x double> %453, %472
  %482 = fmul contract <8 x double> %458, %477
  %483 = fsub contract <8 x double> %481, %482
  %484 = fmul contract <8 x double> %474, %474
  %485 = fmul contract <8 x double> %480, %480
  %486 = fadd contract <8 x double> %484, %485
  %487 = fmul contract <8 x double> %483, %483
  %488 = fadd contract <8 x double> %487, %486
  %489 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %488)
  %490 = fmul contract <8 x double> %453, %477
  %491 = fmul contract <8 x double> %458, %472
  %492 = fadd contract <8 x double> %491, %490
  %493 = fmul contract <8 x double> %467, %463
  %494 = fadd contract <8 x double> %493, %492
  %495 = fcmp contract ogt <8 x double> %494, zeroinitializer
  %496 = select contract <8 x i1> %495, <8 x double> %494, <8 x double> <double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A>
  %497 = getelementptr inbounds [24 x <8 x double>], ptr %294, i64 0, i64 %358
  store <8 x double> %496, ptr %497, align 64
  %498 = load i64, ptr %0, align 64
  %499 = getelementptr inbounds [24 x i64], ptr %295, i64 0, i64 %358
  store i64 %498, ptr %499, align 8
  %500 = fsub contract <8 x double> <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>, %489
  %501 = select contract <8 x i1> %495, <8 x double> %489, <8 x double> %500
  br label %502

502:
  %503 = phi <8 x double> [ %501, %435 ], [ %377, %364 ]
  %504 = add nsw i64 %358, 1
  %505 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %358
  store <8 x double> %503, ptr %505, align 64
  br label %506

506:
  %507 = phi i64 [ %358, %431 ], [ %504, %502 ]
  %508 = add nuw nsw i64 %300, 1
  %509 = load i64, ptr %289, align 8
  %510 = icmp slt i64 %508, %509
  br i1 %510, label %298, label %297
}

define linkonce_odr void @_ZN6Errors8evaluateILb1EEEvRK8ManifoldPKDv8_d(ptr noundef nonnull align 64 dereferenceable(103168) %0, ptr noundef nonnull align 8 dereferenceable(104) %1, ptr noundef %2) comdat align 2 {
  %4 = alloca [9 x <8 x double>], align 64
  %5 = alloca [65 x %struct.Frame.3], align 64
  %6 = alloca [3 x <8 x double>], align 64
  %7 = alloca [3 x <8 x double>], align 64
  %8 = load i64, ptr %1, align 8
  call void @llvm.lifetime.start.p0(i64 49920, ptr nonnull %5)
  %9 = getelementptr inbounds i8, ptr %1, i64 24
  %10 = load ptr, ptr %9, align 8
  br label %13

11:
  %12 = getelementptr inbounds i8, ptr %5, i64 576
  br label %25

13:
  %14 = phi i64 [ 0, %3 ], [ %21, %13 ]
  %15 = and i64 %14, 3
  %16 = icmp eq i64 %15, 0
  %17 = uitofp i1 %16 to double
  %18 = insertelement <8 x double> poison, double %17, i64 0
  %19 = shufflevector <8 x double> %18, <8 x double> poison, <8 x i32> zeroinitializer
  %20 = getelementptr inbounds [9 x <8 x double>], ptr %5, i64 0, i64 %14
  store <8 x double> %19, ptr %20, align 64
  %21 = add nuw nsw i64 %14, 1
  %22 = icmp eq i64 %21, 9
  br i1 %22, label %11, label %13

23:
  %24 = icmp sgt i64 %8, 0
  br i1 %24, label %30, label %234

25:
  %26 = phi i64 [ 0, %11 ], [ %28, %25 ]
  %27 = getelementptr inbounds [3 x <8 x double>], ptr %12, i64 0, i64 %26
  store <8 x double> zeroinitializer, ptr %27, align 64
  %28 = add nuw nsw i64 %26, 1
  %29 = icmp eq i64 %28, 3
  br i1 %29, label %23, label %25

30:
  %31 = phi i64 [ %34, %232 ], [ 0, %23 ]
  %32 = getelementptr inbounds %struct.Joint.6, ptr %10, i64 %31
  %33 = getelementptr inbounds %struct.Frame.3, ptr %5, i64 %31
  %34 = add nuw nsw i64 %31, 1
  %35 = getelementptr inbounds <8 x double>, ptr %2, i64 %31
  %36 = load <8 x double>, ptr %35, align 64
  %37 = getelementptr inbounds i8, ptr %32, i64 72
  %38 = load double, ptr %37, align 8
  %39 = getelementptr inbounds i8, ptr %32, i64 80
  %40 = load double, ptr %39, align 8
  %41 = getelementptr inbounds i8, ptr %32, i64 88
  %42 = load double, ptr %41, align 8
  %43 = getelementptr inbounds i8, ptr %33, i64 576
  %44 = load <8 x double>, ptr %43, align 64
  %45 = load <8 x double>, ptr %33, align 64
  %46 = insertelement <8 x double> poison, double %38, i64 0
  %47 = shufflevector <8 x double> %46, <8 x double> poison, <8 x i32> zeroinitializer
  %48 = fmul contract <8 x double> %47, %45
  %49 = getelementptr inbounds i8, ptr %33, i64 64
  %50 = load <8 x double>, ptr %49, align 64
  %51 = insertelement <8 x double> poison, double %40, i64 0
  %52 = shufflevector <8 x double> %51, <8 x double> poison, <8 x i32> zeroinitializer
  %53 = fmul contract <8 x double> %52, %50
  %54 = getelementptr inbounds i8, ptr %33, i64 128
  %55 = load <8 x double>, ptr %54, align 64
  %56 = insertelement <8 x double> poison, double %42, i64 0
  %57 = shufflevector <8 x double> %56, <8 x double> poison, <8 x i32> zeroinitializer
  %58 = fmul contract <8 x double> %57, %55
  %59 = getelementptr inbounds i8, ptr %33, i64 640
  %60 = load <8 x double>, ptr %59, align 64
  %61 = getelementptr inbounds i8, ptr %33, i64 192
  %62 = load <8 x double>, ptr %61, align 64
  %63 = fmul contract <8 x double> %47, %62
  %64 = getelementptr inbounds i8, ptr %33, i64 256
  %65 = load <8 x double>, ptr %64, align 64
  %66 = fmul contract <8 x double> %52, %65
  %67 = getelementptr inbounds i8, ptr %33, i64 320
  %68 = load <8 x double>, ptr %67, align 64
  %69 = fmul contract <8 x double> %57, %68
  %70 = getelementptr inbounds i8, ptr %33, i64 704
  %71 = load <8 x double>, ptr %70, align 64
  %72 = getelementptr inbounds i8, ptr %33, i64 384
  %73 = load <8 x double>, ptr %72, align 64
  %74 = fmul contract <8 x double> %47, %73
  %75 = getelementptr inbounds i8, ptr %33, i64 448
  %76 = load <8 x double>, ptr %75, align 64
  %77 = fmul contract <8 x double> %52, %76
  %78 = getelementptr inbounds i8, ptr %33, i64 512
  %79 = load <8 x double>, ptr %78, align 64
  %80 = fmul contract <8 x double> %57, %79
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %4)
  br label %81

81:
  %82 = phi i64 [ 0, %30 ], [ %110, %109 ]
  %83 = mul nuw nsw i64 %82, 3
  %84 = getelementptr inbounds [9 x <8 x double>], ptr %33, i64 0, i64 %83
  %85 = load <8 x double>, ptr %84, align 64
  %86 = add nuw nsw i64 %83, 1
  %87 = getelementptr inbounds [9 x <8 x double>], ptr %33, i64 0, i64 %86
  %88 = load <8 x double>, ptr %87, align 64
  %89 = add nuw nsw i64 %83, 2
  %90 = getelementptr inbounds [9 x <8 x double>], ptr %33, i64 0, i64 %89
  %91 = load <8 x double>, ptr %90, align 64
  br label %112

92:
  %93 = getelementptr inbounds %struct.Frame.3, ptr %5, i64 %34
  %94 = fadd contract <8 x double> %44, %48
  %95 = fadd contract <8 x double> %94, %53
  %96 = fadd contract <8 x double> %95, %58
  %97 = fadd contract <8 x double> %60, %63
  %98 = fadd contract <8 x double> %97, %66
  %99 = fadd contract <8 x double> %98, %69
  %100 = fadd contract <8 x double> %71, %74
  %101 = fadd contract <8 x double> %100, %77
  %102 = fadd contract <8 x double> %101, %80
  %103 = getelementptr inbounds i8, ptr %93, i64 576
  store <8 x double> %96, ptr %103, align 64
  %104 = getelementptr inbounds i8, ptr %93, i64 640
  store <8 x double> %99, ptr %104, align 64
  %105 = getelementptr inbounds i8, ptr %93, i64 704
  store <8 x double> %102, ptr %105, align 64
  %106 = getelementptr inbounds i8, ptr %32, i64 96
  %107 = load double, ptr %106, align 8
  %108 = fcmp contract une double %107, 0.000000e+00
  br i1 %108, label %137, label %156

109:
  %110 = add nuw nsw i64 %82, 1
  %111 = icmp eq i64 %110, 3
  br i1 %111, label %92, label %81

112:
  %113 = phi i64 [ 0, %81 ], [ %135, %112 ]
  %114 = getelementptr inbounds [9 x double], ptr %32, i64 0, i64 %113
  %115 = load double, ptr %114, align 8
  %116 = insertelement <8 x double> poison, double %115, i64 0
  %117 = shufflevector <8 x double> %116, <8 x double> poison, <8 x i32> zeroinitializer
  %118 = fmul contract <8 x double> %85, %117
  %119 = add nuw nsw i64 %113, 3
  %120 = getelementptr inbounds [9 x double], ptr %32, i64 0, i64 %119
  %121 = load double, ptr %120, align 8
  %122 = insertelement <8 x double> poison, double %121, i64 0
  %123 = shufflevector <8 x double> %122, <8 x double> poison, <8 x i32> zeroinitializer
  %124 = fmul contract <8 x double> %88, %123
  %125 = fadd contract <8 x double> %118, %124
  %126 = add nuw nsw i64 %113, 6
  %127 = getelementptr inbounds [9 x double], ptr %32, i64 0, i64 %126
  %128 = load double, ptr %127, align 8
  %129 = insertelement <8 x double> poison, double %128, i64 0
  %130 = shufflevector <8 x double> %129, <8 x double> poison, <8 x i32> zeroinitializer
  %131 = fmul contract <8 x double> %91, %130
  %132 = fadd contract <8 x double> %125, %131
  %133 = add nuw nsw i64 %113, %83
  %134 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %133
  store <8 x double> %132, ptr %134, align 64
  %135 = add nuw nsw i64 %113, 1
  %136 = icmp eq i64 %135, 3
  br i1 %136, label %109, label %112

137:
  %138 = phi i64 [ %142, %137 ], [ 0, %92 ]
  %139 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %138
  %140 = load <8 x double>, ptr %139, align 64
  %141 = getelementptr inbounds [9 x <8 x double>], ptr %93, i64 0, i64 %138
  store <8 x double> %140, ptr %141, align 64
  %142 = add nuw nsw i64 %138, 1
  %143 = icmp eq i64 %142, 9
  br i1 %143, label %144, label %137

144:
  %145 = phi i64 [ %154, %144 ], [ 0, %137 ]
  %146 = mul nuw nsw i64 %145, 3
  %147 = add nuw nsw i64 %146, 2
  %148 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %147
  %149 = load <8 x double>, ptr %148, align 64
  %150 = fmul contract <8 x double> %36, %149
  %151 = getelementptr inbounds [3 x <8 x double>], ptr %103, i64 0, i64 %145
  %152 = load <8 x double>, ptr %151, align 64
  %153 = fadd contract <8 x double> %152, %150
  store <8 x double> %153, ptr %151, align 64
  %154 = add nuw nsw i64 %145, 1
  %155 = icmp eq i64 %154, 3
  br i1 %155, label %232, label %144

156:
  %157 = fmul contract <8 x double> %36, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %158 = fadd contract <8 x double> %157, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %159 = fadd contract <8 x double> %158, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %160 = fmul contract <8 x double> %159, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %161 = fsub contract <8 x double> %36, %160
  %162 = fmul contract <8 x double> %159, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %163 = fsub contract <8 x double> %161, %162
  %164 = fmul contract <8 x double> %159, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %165 = fsub contract <8 x double> %163, %164
  %166 = fmul contract <8 x double> %159, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %167 = fadd contract <8 x double> %166, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %168 = fadd contract <8 x double> %167, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %169 = fsub contract <8 x double> %166, %168
  %170 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %169)
  %171 = fmul contract <8 x double> %170, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %172 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %171
  %173 = fmul contract <8 x double> %165, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %174 = fmul contract <8 x double> %173, %173
  %175 = fmul contract <8 x double> %173, %174
  %176 = fmul contract <8 x double> %174, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %177 = fadd contract <8 x double> %176, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %178 = fmul contract <8 x double> %174, %177
  %179 = fadd contract <8 x double> %178, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %180 = fmul contract <8 x double> %174, %179
  %181 = fadd contract <8 x double> %180, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %182 = fmul contract <8 x double> %174, %181
  %183 = fadd contract <8 x double> %182, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %184 = fmul contract <8 x double> %174, %183
  %185 = fadd contract <8 x double> %184, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %186 = fmul contract <8 x double> %175, %185
  %187 = fadd contract <8 x double> %173, %186
  %188 = fmul contract <8 x double> %174, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %189 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %188
  %190 = fmul contract <8 x double> %174, %174
  %191 = fmul contract <8 x double> %174, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %192 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %191
  %193 = fmul contract <8 x double> %174, %192
  %194 = fadd contract <8 x double> %193, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %195 = fmul contract <8 x double> %174, %194
  %196 = fadd contract <8 x double> %195, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %197 = fmul contract <8 x double> %174, %196
  %198 = fadd contract <8 x double> %197, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %199 = fmul contract <8 x double> %174, %198
  %200 = fadd contract <8 x double> %199, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %201 = fmul contract <8 x double> %190, %200
  %202 = fadd contract <8 x double> %189, %201
  %203 = fmul contract <8 x double> %172, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %204 = fmul contract <8 x double> %203, %187
  %205 = fmul contract <8 x double> %202, %204
  %206 = fmul contract <8 x double> %187, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %207 = fmul contract <8 x double> %187, %206
  %208 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %207
  %209 = fmul contract <8 x double> %172, %208
  br label %210

210:
  %211 = phi i64 [ 0, %156 ], [ %230, %210 ]
  %212 = mul nuw nsw i64 %211, 3
  %213 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %212
  %214 = load <8 x double>, ptr %213, align 64
  %215 = fmul contract <8 x double> %209, %214
  %216 = add nuw nsw i64 %212, 1
  %217 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %216
  %218 = load <8 x double>, ptr %217, align 64
  %219 = fmul contract <8 x double> %205, %218
  %220 = fadd contract <8 x double> %215, %219
  %221 = getelementptr inbounds [9 x <8 x double>], ptr %93, i64 0, i64 %212
  store <8 x double> %220, ptr %221, align 64
  %222 = fmul contract <8 x double> %209, %218
  %223 = fmul contract <8 x double> %205, %214
  %224 = fsub contract <8 x double> %222, %223
  %225 = getelementptr inbounds [9 x <8 x double>], ptr %93, i64 0, i64 %216
  store <8 x double> %224, ptr %225, align 64
  %226 = add nuw nsw i64 %212, 2
  %227 = getelementptr inbounds [9 x <8 x double>], ptr %4, i64 0, i64 %226
  %228 = load <8 x double>, ptr %227, align 64
  %229 = getelementptr inbounds [9 x <8 x double>], ptr %93, i64 0, i64 %226
  store <8 x double> %228, ptr %229, align 64
  %230 = add nuw nsw i64 %211, 1
  %231 = icmp eq i64 %230, 3
  br i1 %231, label %232, label %210

232:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %4)
  %233 = icmp eq i64 %34, %8
  br i1 %233, label %234, label %30

234:
  %235 = getelementptr inbounds i8, ptr %1, i64 40
  %236 = load ptr, ptr %235, align 8
  %237 = getelementptr inbounds [65 x %struct.Frame.3], ptr %5, i64 0, i64 %8
  %238 = getelementptr inbounds i8, ptr %236, i64 72
  %239 = load double, ptr %238, align 8
  %240 = getelementptr inbounds i8, ptr %236, i64 80
  %241 = load double, ptr %240, align 8
  %242 = getelementptr inbounds i8, ptr %236, i64 88
  %243 = load double, ptr %242, align 8
  %244 = getelementptr inbounds i8, ptr %237, i64 576
  %245 = load <8 x double>, ptr %244, align 64
  %246 = load <8 x double>, ptr %237, align 64
  %247 = insertelement <8 x double> poison, double %239, i64 0
  %248 = shufflevector <8 x double> %247, <8 x double> poison, <8 x i32> zeroinitializer
  %249 = fmul contract <8 x double> %248, %246
  %250 = fadd contract <8 x double> %245, %249
  %251 = getelementptr inbounds i8, ptr %237, i64 64
  %252 = load <8 x double>, ptr %251, align 64
  %253 = insertelement <8 x double> poison, double %241, i64 0
  %254 = shufflevector <8 x double> %253, <8 x double> poison, <8 x i32> zeroinitializer
  %255 = fmul contract <8 x double> %254, %252
  %256 = fadd contract <8 x double> %250, %255
  %257 = getelementptr inbounds i8, ptr %237, i64 128
  %258 = load <8 x double>, ptr %257, align 64
  %259 = insertelement <8 x double> poison, double %243, i64 0
  %260 = shufflevector <8 x double> %259, <8 x double> poison, <8 x i32> zeroinitializer
  %261 = fmul contract <8 x double> %260, %258
  %262 = fadd contract <8 x double> %256, %261
  %263 = getelementptr inbounds i8, ptr %237, i64 640
  %264 = load <8 x double>, ptr %263, align 64
  %265 = getelementptr inbounds i8, ptr %237, i64 192
  %266 = load <8 x double>, ptr %265, align 64
  %267 = fmul contract <8 x double> %248, %266
  %268 = fadd contract <8 x double> %264, %267
  %269 = getelementptr inbounds i8, ptr %237, i64 256
  %270 = load <8 x double>, ptr %269, align 64
  %271 = fmul contract <8 x double> %254, %270
  %272 = fadd contract <8 x double> %268, %271
  %273 = getelementptr inbounds i8, ptr %237, i64 320
  %274 = load <8 x double>, ptr %273, align 64
  %275 = fmul contract <8 x double> %260, %274
  %276 = fadd contract <8 x double> %272, %275
  %277 = getelementptr inbounds i8, ptr %237, i64 704
  %278 = load <8 x double>, ptr %277, align 64
  %279 = getelementptr inbounds i8, ptr %237, i64 384
  %280 = load <8 x double>, ptr %279, align 64
  %281 = fmul contract <8 x double> %248, %280
  %282 = fadd contract <8 x double> %278, %281
  %283 = getelementptr inbounds i8, ptr %237, i64 448
  %284 = load <8 x double>, ptr %283, align 64
  %285 = fmul contract <8 x double> %254, %284
  %286 = fadd contract <8 x double> %282, %285
  %287 = getelementptr inbounds i8, ptr %237, i64 512
  %288 = load <8 x double>, ptr %287, align 64
  %289 = fmul contract <8 x double> %260, %288
  %290 = fadd contract <8 x double> %286, %289
  store i64 0, ptr %0, align 64
  %291 = getelementptr inbounds i8, ptr %1, i64 8
  %292 = load i64, ptr %291, align 8
  %293 = icmp sgt i64 %292, 0
  br i1 %293, label %294, label %306

294:
  %295 = getelementptr inbounds i8, ptr %1, i64 32
  %296 = getelementptr inbounds i8, ptr %0, i64 1792
  %297 = getelementptr inbounds i8, ptr %0, i64 3328
  %298 = getelementptr inbounds i8, ptr %1, i64 80
  %299 = getelementptr inbounds i8, ptr %0, i64 101632
  %300 = getelementptr inbounds i8, ptr %0, i64 8
  %301 = getelementptr inbounds i8, ptr %0, i64 256
  %302 = getelementptr inbounds i8, ptr %6, i64 64
  %303 = getelementptr inbounds i8, ptr %6, i64 128
  %304 = getelementptr inbounds i8, ptr %7, i64 64
  %305 = getelementptr inbounds i8, ptr %7, i64 128
  br label %307

306:
  call void @llvm.lifetime.end.p0(i64 49920, ptr nonnull %5)
  ret void

307:
  %308 = phi i64 [ 0, %294 ], [ %941, %940 ]
  %309 = phi i64 [ 0, %294 ], [ %942, %940 ]
  %310 = load ptr, ptr %295, align 8
  %311 = getelementptr inbounds %struct.Constraint, ptr %310, i64 %309
  %312 = load i64, ptr %311, align 8
  %313 = icmp eq i64 %312, 0
  br i1 %313, label %427, label %314

314:
  %315 = icmp sgt i64 %312, 0
  br i1 %315, label %316, label %322

316:
  %317 = getelementptr inbounds i8, ptr %311, i64 24
  %318 = getelementptr inbounds i8, ptr %311, i64 96
  %319 = getelementptr inbounds i8, ptr %311, i64 104
  %320 = getelementptr inbounds i8, ptr %311, i64 112
  %321 = load i64, ptr %0, align 64
  br label %330

322:
  %323 = phi <8 x double> [ zeroinitializer, %314 ], [ %365, %421 ]
  %324 = getelementptr inbounds [24 x <8 x double>], ptr %299, i64 0, i64 %308
  store <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, ptr %324, align 64
  %325 = load i64, ptr %0, align 64
  %326 = getelementptr inbounds [24 x i64], ptr %300, i64 0, i64 %308
  store i64 %325, ptr %326, align 8
  %327 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %323)
  %328 = add nsw i64 %308, 1
  %329 = getelementptr inbounds [24 x <8 x double>], ptr %301, i64 0, i64 %308
  store <8 x double> %327, ptr %329, align 64
  br label %427

330:
  %331 = phi i64 [ %321, %316 ], [ %423, %421 ]
  %332 = phi <8 x double> [ zeroinitializer, %316 ], [ %365, %421 ]
  %333 = phi i64 [ 0, %316 ], [ %424, %421 ]
  %334 = mul i64 %333, 24
  %335 = getelementptr inbounds i8, ptr %317, i64 %334
  %336 = load double, ptr %318, align 8
  %337 = insertelement <8 x double> poison, double %336, i64 0
  %338 = shufflevector <8 x double> %337, <8 x double> poison, <8 x i32> zeroinitializer
  %339 = fsub contract <8 x double> %338, %262
  %340 = load double, ptr %335, align 8
  %341 = insertelement <8 x double> poison, double %340, i64 0
  %342 = shufflevector <8 x double> %341, <8 x double> poison, <8 x i32> zeroinitializer
  %343 = fmul contract <8 x double> %339, %342
  %344 = load double, ptr %319, align 8
  %345 = insertelement <8 x double> poison, double %344, i64 0
  %346 = shufflevector <8 x double> %345, <8 x double> poison, <8 x i32> zeroinitializer
  %347 = fsub contract <8 x double> %346, %276
  %348 = getelementptr inbounds i8, ptr %335, i64 8
  %349 = load double, ptr %348, align 8
  %350 = insertelement <8 x double> poison, double %349, i64 0
  %351 = shufflevector <8 x double> %350, <8 x double> poison, <8 x i32> zeroinitializer
  %352 = fmul contract <8 x double> %347, %351
  %353 = fadd contract <8 x double> %343, %352
  %354 = load double, ptr %320, align 8
  %355 = insertelement <8 x double> poison, double %354, i64 0
  %356 = shufflevector <8 x double> %355, <8 x double> poison, <8 x i32> zeroinitializer
  %357 = fsub contract <8 x double> %356, %290
  %358 = getelementptr inbounds i8, ptr %335, i64 16
  %359 = load double, ptr %358, align 8
  %360 = insertelement <8 x double> poison, double %359, i64 0
  %361 = shufflevector <8 x double> %360, <8 x double> poison, <8 x i32> zeroinitializer
  %362 = fmul contract <8 x double> %357, %361
  %363 = fadd contract <8 x double> %353, %362
  %364 = fmul contract <8 x double> %363, %363
  %365 = fadd contract <8 x double> %332, %364
  %366 = fadd contract <8 x double> %342, zeroinitializer
  %367 = fadd contract <8 x double> %350, <double 0.000000e+00, double poison, double poison, double poison, double poison, double poison, double poison, double poison>
  %368 = shufflevector <8 x double> %367, <8 x double> poison, <8 x i32> zeroinitializer
  %369 = fadd contract <8 x double> %360, <double 0.000000e+00, double poison, double poison, double poison, double poison, double poison, double poison, double poison>
  %370 = shufflevector <8 x double> %369, <8 x double> poison, <8 x i32> zeroinitializer
  %371 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %331
  store <8 x double> %363, ptr %371, align 64
  br i1 %24, label %372, label %421

372:
  %373 = phi i64 [ %374, %416 ], [ 0, %330 ]
  %374 = add nuw nsw i64 %373, 1
  %375 = getelementptr inbounds [65 x %struct.Frame.3], ptr %5, i64 0, i64 %374
  %376 = getelementptr inbounds i8, ptr %375, i64 128
  %377 = load <8 x double>, ptr %376, align 64
  %378 = getelementptr inbounds i8, ptr %375, i64 320
  %379 = load <8 x double>, ptr %378, align 64
  %380 = getelementptr inbounds i8, ptr %375, i64 512
  %381 = load <8 x double>, ptr %380, align 64
  %382 = load ptr, ptr %298, align 8
  %383 = getelementptr inbounds double, ptr %382, i64 %373
  %384 = load double, ptr %383, align 8
  %385 = fcmp contract une double %384, 0.000000e+00
  br i1 %385, label %392, label %386

386:
  %387 = fmul contract <8 x double> %366, %377
  %388 = fmul contract <8 x double> %368, %379
  %389 = fadd contract <8 x double> %387, %388
  %390 = fmul contract <8 x double> %370, %381
  %391 = fadd contract <8 x double> %389, %390
  br label %416

392:
  %393 = getelementptr inbounds i8, ptr %375, i64 704
  %394 = load <8 x double>, ptr %393, align 64
  %395 = fsub contract <8 x double> %290, %394
  %396 = getelementptr inbounds i8, ptr %375, i64 640
  %397 = load <8 x double>, ptr %396, align 64
  %398 = fsub contract <8 x double> %276, %397
  %399 = getelementptr inbounds i8, ptr %375, i64 576
  %400 = load <8 x double>, ptr %399, align 64
  %401 = fsub contract <8 x double> %262, %400
  %402 = fmul contract <8 x double> %379, %395
  %403 = fmul contract <8 x double> %381, %398
  %404 = fsub contract <8 x double> %402, %403
  %405 = fmul contract <8 x double> %366, %404
  %406 = fmul contract <8 x double> %381, %401
  %407 = fmul contract <8 x double> %377, %395
  %408 = fsub contract <8 x double> %406, %407
  %409 = fmul contract <8 x double> %368, %408
  %410 = fadd contract <8 x double> %405, %409
  %411 = fmul contract <8 x double> %377, %398
  %412 = fmul contract <8 x double> %379, %401
  %413 = fsub contract <8 x double> %411, %412
  %414 = fmul contract <8 x double> %370, %413
  %415 = fadd contract <8 x double> %414, %410
  br label %416

416:
  %417 = phi <8 x double> [ %415, %392 ], [ %391, %386 ]
  %418 = load i64, ptr %0, align 64
  %419 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %297, i64 0, i64 %418, i64 %373
  store <8 x double> %417, ptr %419, align 64
  %420 = icmp eq i64 %374, %8
  br i1 %420, label %421, label %372

421:
  %422 = load i64, ptr %0, align 64
  %423 = add nsw i64 %422, 1
  store i64 %423, ptr %0, align 64
  %424 = add nuw nsw i64 %333, 1
  %425 = load i64, ptr %311, align 8
  %426 = icmp slt i64 %424, %425
  br i1 %426, label %330, label %322

427:
  %428 = phi i64 [ %328, %322 ], [ %308, %307 ]
  %429 = getelementptr inbounds i8, ptr %311, i64 8
  %430 = load i64, ptr %429, align 8
  %431 = icmp eq i64 %430, 0
  br i1 %431, label %625, label %432

432:
  %433 = getelementptr inbounds i8, ptr %311, i64 120
  br label %554

434:
  %435 = fmul contract <8 x double> %607, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %436 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %435)
  %437 = fmul contract <8 x double> %612, %612
  %438 = fmul contract <8 x double> %617, %617
  %439 = fadd contract <8 x double> %437, %438
  %440 = fmul contract <8 x double> %622, %622
  %441 = fadd contract <8 x double> %439, %440
  %442 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %441)
  %443 = fcmp contract ogt <8 x double> %442, <double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11>
  %444 = select contract <8 x i1> %443, <8 x double> %442, <8 x double> <double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11, double 0x3D719799812DEA11>
  %445 = fdiv contract <8 x double> %436, %444
  %446 = fmul contract <8 x double> %612, %445
  %447 = load i64, ptr %0, align 64
  %448 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %447
  store <8 x double> %446, ptr %448, align 64
  br i1 %24, label %458, label %449

449:
  %450 = load i64, ptr %0, align 64
  %451 = add nsw i64 %450, 1
  store i64 %451, ptr %0, align 64
  %452 = fmul contract <8 x double> %617, %445
  %453 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %451
  store <8 x double> %452, ptr %453, align 64
  %454 = load i64, ptr %0, align 64
  %455 = add nsw i64 %454, 1
  store i64 %455, ptr %0, align 64
  %456 = fmul contract <8 x double> %622, %445
  %457 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %455
  store <8 x double> %456, ptr %457, align 64
  br label %540

458:
  %459 = phi i64 [ %460, %477 ], [ 0, %434 ]
  %460 = add nuw nsw i64 %459, 1
  %461 = load ptr, ptr %298, align 8
  %462 = getelementptr inbounds double, ptr %461, i64 %459
  %463 = load double, ptr %462, align 8
  %464 = fcmp contract oeq double %463, 0.000000e+00
  br i1 %464, label %477, label %465

465:
  %466 = getelementptr inbounds [65 x %struct.Frame.3], ptr %5, i64 0, i64 %460
  %467 = getelementptr inbounds i8, ptr %466, i64 512
  %468 = load <8 x double>, ptr %467, align 64
  %469 = getelementptr inbounds i8, ptr %466, i64 320
  %470 = load <8 x double>, ptr %469, align 64
  %471 = getelementptr inbounds i8, ptr %466, i64 128
  %472 = load <8 x double>, ptr %471, align 64
  %473 = fmul contract <8 x double> %470, zeroinitializer
  %474 = fadd contract <8 x double> %472, %473
  %475 = fmul contract <8 x double> %468, zeroinitializer
  %476 = fadd contract <8 x double> %475, %474
  br label %477

477:
  %478 = phi contract <8 x double> [ %476, %465 ], [ zeroinitializer, %458 ]
  %479 = load i64, ptr %0, align 64
  %480 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %297, i64 0, i64 %479, i64 %459
  store <8 x double> %478, ptr %480, align 64
  %481 = icmp eq i64 %460, %8
  br i1 %481, label %482, label %458

482:
  %483 = load i64, ptr %0, align 64
  %484 = add nsw i64 %483, 1
  store i64 %484, ptr %0, align 64
  %485 = fmul contract <8 x double> %617, %445
  %486 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %484
  store <8 x double> %485, ptr %486, align 64
  br label %487

487:
  %488 = phi i64 [ 0, %482 ], [ %489, %506 ]
  %489 = add nuw nsw i64 %488, 1
  %490 = load ptr, ptr %298, align 8
  %491 = getelementptr inbounds double, ptr %490, i64 %488
  %492 = load double, ptr %491, align 8
  %493 = fcmp contract oeq double %492, 0.000000e+00
  br i1 %493, label %506, label %494

494:
  %495 = getelementptr inbounds [65 x %struct.Frame.3], ptr %5, i64 0, i64 %489
  %496 = getelementptr inbounds i8, ptr %495, i64 512
  %497 = load <8 x double>, ptr %496, align 64
  %498 = getelementptr inbounds i8, ptr %495, i64 320
  %499 = load <8 x double>, ptr %498, align 64
  %500 = getelementptr inbounds i8, ptr %495, i64 128
  %501 = load <8 x double>, ptr %500, align 64
  %502 = fmul contract <8 x double> %501, zeroinitializer
  %503 = fadd contract <8 x double> %499, %502
  %504 = fmul contract <8 x double> %497, zeroinitializer
  %505 = fadd contract <8 x double> %504, %503
  br label %506

506:
  %507 = phi contract <8 x double> [ %505, %494 ], [ zeroinitializer, %487 ]
  %508 = load i64, ptr %0, align 64
  %509 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %297, i64 0, i64 %508, i64 %488
  store <8 x double> %507, ptr %509, align 64
  %510 = icmp eq i64 %489, %8
  br i1 %510, label %511, label %487

511:
  %512 = load i64, ptr %0, align 64
  %513 = add nsw i64 %512, 1
  store i64 %513, ptr %0, align 64
  %514 = fmul contract <8 x double> %622, %445
  %515 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %513
  store <8 x double> %514, ptr %515, align 64
  br label %516

516:
  %517 = phi i64 [ 0, %511 ], [ %518, %535 ]
  %518 = add nuw nsw i64 %517, 1
  %519 = load ptr, ptr %298, align 8
  %520 = getelementptr inbounds double, ptr %519, i64 %517
  %521 = load double, ptr %520, align 8
  %522 = fcmp contract oeq double %521, 0.000000e+00
  br i1 %522, label %535, label %523

523:
  %524 = getelementptr inbounds [65 x %struct.Frame.3], ptr %5, i64 0, i64 %518
  %525 = getelementptr inbounds i8, ptr %524, i64 512
  %526 = load <8 x double>, ptr %525, align 64
  %527 = getelementptr inbounds i8, ptr %524, i64 320
  %528 = load <8 x double>, ptr %527, align 64
  %529 = getelementptr inbounds i8, ptr %524, i64 128
  %530 = load <8 x double>, ptr %529, align 64
  %531 = fmul contract <8 x double> %530, zeroinitializer
  %532 = fmul contract <8 x double> %528, zeroinitializer
  %533 = fadd contract <8 x double> %532, %531
  %534 = fadd contract <8 x double> %526, %533
  br label %535

535:
  %536 = phi contract <8 x double> [ %534, %523 ], [ zeroinitializer, %516 ]
  %537 = load i64, ptr %0, align 64
  %538 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %297, i64 0, i64 %537, i64 %517
  store <8 x double> %536, ptr %538, align 64
  %539 = icmp eq i64 %518, %8
  br i1 %539, label %540, label %516

540:
  %541 = load i64, ptr %0, align 64
  %542 = add nsw i64 %541, 1
  store i64 %542, ptr %0, align 64
  %543 = fmul contract <8 x double> %436, <double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01>
  %544 = fmul contract <8 x double> %436, %543
  %545 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %544
  %546 = fcmp contract ogt <8 x double> %545, zeroinitializer
  %547 = select contract <8 x i1> %546, <8 x double> %545, <8 x double> zeroinitializer
  %548 = fmul contract <8 x double> %547, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %549 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %548)
  %550 = getelementptr inbounds [24 x <8 x double>], ptr %299, i64 0, i64 %428
  store <8 x double> %549, ptr %550, align 64
  %551 = load i64, ptr %0, align 64
  %552 = getelementptr inbounds [24 x i64], ptr %300, i64 0, i64 %428
  store i64 %551, ptr %552, align 8
  %553 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %607)
  br label %936

554:
  %555 = phi <8 x double> [ zeroinitializer, %432 ], [ %607, %554 ]
  %556 = phi i64 [ 0, %432 ], [ %623, %554 ]
  %557 = phi <8 x double> [ zeroinitializer, %432 ], [ %622, %554 ]
  %558 = phi <8 x double> [ zeroinitializer, %432 ], [ %617, %554 ]
  %559 = phi <8 x double> [ zeroinitializer, %432 ], [ %612, %554 ]
  %560 = getelementptr inbounds double, ptr %236, i64 %556
  %561 = load double, ptr %560, align 8
  %562 = getelementptr inbounds i8, ptr %560, i64 24
  %563 = load double, ptr %562, align 8
  %564 = getelementptr inbounds i8, ptr %560, i64 48
  %565 = load double, ptr %564, align 8
  %566 = insertelement <8 x double> poison, double %561, i64 0
  %567 = shufflevector <8 x double> %566, <8 x double> poison, <8 x i32> zeroinitializer
  %568 = fmul contract <8 x double> %246, %567
  %569 = insertelement <8 x double> poison, double %563, i64 0
  %570 = shufflevector <8 x double> %569, <8 x double> poison, <8 x i32> zeroinitializer
  %571 = fmul contract <8 x double> %252, %570
  %572 = fadd contract <8 x double> %568, %571
  %573 = insertelement <8 x double> poison, double %565, i64 0
  %574 = shufflevector <8 x double> %573, <8 x double> poison, <8 x i32> zeroinitializer
  %575 = fmul contract <8 x double> %258, %574
  %576 = fadd contract <8 x double> %572, %575
  %577 = fmul contract <8 x double> %266, %567
  %578 = fmul contract <8 x double> %270, %570
  %579 = fadd contract <8 x double> %577, %578
  %580 = fmul contract <8 x double> %274, %574
  %581 = fadd contract <8 x double> %579, %580
  %582 = fmul contract <8 x double> %280, %567
  %583 = fmul contract <8 x double> %284, %570
  %584 = fadd contract <8 x double> %582, %583
  %585 = fmul contract <8 x double> %288, %574
  %586 = fadd contract <8 x double> %584, %585
  %587 = getelementptr inbounds double, ptr %433, i64 %556
  %588 = load double, ptr %587, align 8
  %589 = insertelement <8 x double> poison, double %588, i64 0
  %590 = shufflevector <8 x double> %589, <8 x double> poison, <8 x i32> zeroinitializer
  %591 = fsub contract <8 x double> %576, %590
  %592 = getelementptr inbounds i8, ptr %587, i64 24
  %593 = load double, ptr %592, align 8
  %594 = insertelement <8 x double> poison, double %593, i64 0
  %595 = shufflevector <8 x double> %594, <8 x double> poison, <8 x i32> zeroinitializer
  %596 = fsub contract <8 x double> %581, %595
  %597 = getelementptr inbounds i8, ptr %587, i64 48
  %598 = load double, ptr %597, align 8
  %599 = insertelement <8 x double> poison, double %598, i64 0
  %600 = shufflevector <8 x double> %599, <8 x double> poison, <8 x i32> zeroinitializer
  %601 = fsub contract <8 x double> %586, %600
  %602 = fmul contract <8 x double> %591, %591
  %603 = fmul contract <8 x double> %596, %596
  %604 = fadd contract <8 x double> %602, %603
  %605 = fmul contract <8 x double> %601, %601
  %606 = fadd contract <8 x double> %604, %605
  %607 = fadd contract <8 x double> %555, %606
  %608 = fmul contract <8 x double> %581, %600
  %609 = fmul contract <8 x double> %586, %595
  %610 = fsub contract <8 x double> %608, %609
  %611 = fmul contract <8 x double> %610, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %612 = fadd contract <8 x double> %559, %611
  %613 = fmul contract <8 x double> %590, %586
  %614 = fmul contract <8 x double> %576, %600
  %615 = fsub contract <8 x double> %613, %614
  %616 = fmul contract <8 x double> %615, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %617 = fadd contract <8 x double> %558, %616
  %618 = fmul contract <8 x double> %576, %595
  %619 = fmul contract <8 x double> %590, %581
  %620 = fsub contract <8 x double> %618, %619
  %621 = fmul contract <8 x double> %620, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %622 = fadd contract <8 x double> %557, %621
  %623 = add nuw nsw i64 %556, 1
  %624 = icmp eq i64 %623, 3
  br i1 %624, label %434, label %554

625:
  %626 = getelementptr inbounds i8, ptr %311, i64 16
  %627 = load i64, ptr %626, align 8
  %628 = icmp eq i64 %627, 0
  br i1 %628, label %940, label %629

629:
  %630 = getelementptr inbounds i8, ptr %311, i64 192
  %631 = getelementptr inbounds i8, ptr %311, i64 216
  %632 = load double, ptr %631, align 8
  %633 = insertelement <8 x double> poison, double %632, i64 0
  %634 = shufflevector <8 x double> %633, <8 x double> poison, <8 x i32> zeroinitializer
  %635 = fmul contract <8 x double> %246, %634
  %636 = getelementptr inbounds i8, ptr %311, i64 224
  %637 = load double, ptr %636, align 8
  %638 = insertelement <8 x double> poison, double %637, i64 0
  %639 = shufflevector <8 x double> %638, <8 x double> poison, <8 x i32> zeroinitializer
  %640 = fmul contract <8 x double> %252, %639
  %641 = fadd contract <8 x double> %635, %640
  %642 = getelementptr inbounds i8, ptr %311, i64 232
  %643 = load double, ptr %642, align 8
  %644 = insertelement <8 x double> poison, double %643, i64 0
  %645 = shufflevector <8 x double> %644, <8 x double> poison, <8 x i32> zeroinitializer
  %646 = fmul contract <8 x double> %258, %645
  %647 = fadd contract <8 x double> %641, %646
  %648 = fmul contract <8 x double> %266, %634
  %649 = fmul contract <8 x double> %270, %639
  %650 = fadd contract <8 x double> %648, %649
  %651 = fmul contract <8 x double> %274, %645
  %652 = fadd contract <8 x double> %650, %651
  %653 = fmul contract <8 x double> %280, %634
  %654 = fmul contract <8 x double> %284, %639
  %655 = fadd contract <8 x double> %653, %654
  %656 = fmul contract <8 x double> %288, %645
  %657 = fadd contract <8 x double> %655, %656
  %658 = getelementptr inbounds i8, ptr %311, i64 208
  %659 = load double, ptr %658, align 8
  %660 = insertelement <8 x double> poison, double %659, i64 0
  %661 = shufflevector <8 x double> %660, <8 x double> poison, <8 x i32> zeroinitializer
  %662 = fmul contract <8 x double> %661, %652
  %663 = getelementptr inbounds i8, ptr %311, i64 200
  %664 = load double, ptr %663, align 8
  %665 = insertelement <8 x double> poison, double %664, i64 0
  %666 = shufflevector <8 x double> %665, <8 x double> poison, <8 x i32> zeroinitializer
  %667 = fmul contract <8 x double> %657, %666
  %668 = fsub contract <8 x double> %662, %667
  %669 = load double, ptr %630, align 8
  %670 = insertelement <8 x double> poison, double %669, i64 0
  %671 = shufflevector <8 x double> %670, <8 x double> poison, <8 x i32> zeroinitializer
  %672 = fmul contract <8 x double> %657, %671
  %673 = fmul contract <8 x double> %661, %647
  %674 = fsub contract <8 x double> %672, %673
  %675 = fmul contract <8 x double> %647, %666
  %676 = fmul contract <8 x double> %652, %671
  %677 = fsub contract <8 x double> %675, %676
  %678 = fsub contract <8 x double> %647, %671
  %679 = fsub contract <8 x double> %652, %666
  %680 = fsub contract <8 x double> %657, %661
  %681 = fmul contract <8 x double> %678, %678
  %682 = fmul contract <8 x double> %679, %679
  %683 = fadd contract <8 x double> %682, %681
  %684 = fmul contract <8 x double> %680, %680
  %685 = fadd contract <8 x double> %684, %683
  %686 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %685)
  %687 = fmul contract <8 x double> %668, %668
  %688 = fmul contract <8 x double> %674, %674
  %689 = fadd contract <8 x double> %687, %688
  %690 = fmul contract <8 x double> %677, %677
  %691 = fadd contract <8 x double> %690, %689
  %692 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %691)
  %693 = fmul contract <8 x double> %647, %671
  %694 = fmul contract <8 x double> %652, %666
  %695 = fadd contract <8 x double> %694, %693
  %696 = fmul contract <8 x double> %661, %657
  %697 = fadd contract <8 x double> %696, %695
  %698 = fcmp contract olt <8 x double> %692, <double 1.000000e-09, double 1.000000e-09, double 1.000000e-09, double 1.000000e-09, double 1.000000e-09, double 1.000000e-09, double 1.000000e-09, double 1.000000e-09>
  %699 = fmul contract <8 x double> %647, %647
  %700 = fcmp contract ogt <8 x double> %699, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %701 = fneg contract <8 x double> %657
  %702 = select contract <8 x i1> %700, <8 x double> %701, <8 x double> zeroinitializer
  %703 = select contract <8 x i1> %698, <8 x double> %702, <8 x double> %668
  %704 = select contract <8 x i1> %700, <8 x double> zeroinitializer, <8 x double> %657
  %705 = select contract <8 x i1> %698, <8 x double> %704, <8 x double> %674
  %706 = fneg contract <8 x double> %652
  %707 = select contract <8 x i1> %700, <8 x double> %647, <8 x double> %706
  %708 = select contract <8 x i1> %698, <8 x double> %707, <8 x double> %677
  %709 = fmul contract <8 x double> %703, %703
  %710 = fmul contract <8 x double> %705, %705
  %711 = fadd contract <8 x double> %709, %710
  %712 = fmul contract <8 x double> %708, %708
  %713 = fadd contract <8 x double> %712, %711
  %714 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %713)
  %715 = fdiv contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %714
  %716 = getelementptr inbounds i8, ptr %311, i64 240
  %717 = load double, ptr %716, align 8
  %718 = fcmp contract oeq double %717, 0.000000e+00
  br i1 %718, label %719, label %774

719:
  call void @llvm.lifetime.start.p0(i64 192, ptr nonnull %6)
  store <8 x double> %647, ptr %6, align 64
  store <8 x double> %652, ptr %302, align 64
  store <8 x double> %657, ptr %303, align 64
  call void @llvm.lifetime.start.p0(i64 192, ptr nonnull %7)
  store <8 x double> %703, ptr %7, align 64
  store <8 x double> %705, ptr %304, align 64
  store <8 x double> %708, ptr %305, align 64
  %720 = load i64, ptr %0, align 64
  br label %722

721:
  call void @llvm.lifetime.end.p0(i64 192, ptr nonnull %7)
  call void @llvm.lifetime.end.p0(i64 192, ptr nonnull %6)
  br label %928

722:
  %723 = phi i64 [ %720, %719 ], [ %771, %769 ]
  %724 = phi i64 [ 0, %719 ], [ %772, %769 ]
  %725 = getelementptr inbounds [3 x <8 x double>], ptr %6, i64 0, i64 %724
  %726 = load <8 x double>, ptr %725, align 64
  %727 = getelementptr inbounds [3 x %struct.Point.7], ptr @__const._ZN6Errors8evaluateILb1EEEvRK8ManifoldPKDv8_d.unit, i64 0, i64 %724
  %728 = load <8 x double>, ptr %727, align 64
  %729 = fmul contract <8 x double> %647, %726
  %730 = fsub contract <8 x double> %728, %729
  %731 = getelementptr inbounds i8, ptr %727, i64 64
  %732 = load <8 x double>, ptr %731, align 64
  %733 = fmul contract <8 x double> %652, %726
  %734 = fsub contract <8 x double> %732, %733
  %735 = getelementptr inbounds i8, ptr %727, i64 128
  %736 = load <8 x double>, ptr %735, align 64
  %737 = fmul contract <8 x double> %657, %726
  %738 = fsub contract <8 x double> %736, %737
  %739 = getelementptr inbounds [3 x <8 x double>], ptr %7, i64 0, i64 %724
  %740 = load <8 x double>, ptr %739, align 64
  %741 = fmul contract <8 x double> %686, %740
  %742 = fmul contract <8 x double> %715, %741
  %743 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %723
  store <8 x double> %742, ptr %743, align 64
  br i1 %24, label %744, label %769

744:
  %745 = phi i64 [ %746, %764 ], [ 0, %722 ]
  %746 = add nuw nsw i64 %745, 1
  %747 = load ptr, ptr %298, align 8
  %748 = getelementptr inbounds double, ptr %747, i64 %745
  %749 = load double, ptr %748, align 8
  %750 = fcmp contract oeq double %749, 0.000000e+00
  br i1 %750, label %764, label %751

751:
  %752 = getelementptr inbounds [65 x %struct.Frame.3], ptr %5, i64 0, i64 %746
  %753 = getelementptr inbounds i8, ptr %752, i64 512
  %754 = load <8 x double>, ptr %753, align 64
  %755 = getelementptr inbounds i8, ptr %752, i64 320
  %756 = load <8 x double>, ptr %755, align 64
  %757 = getelementptr inbounds i8, ptr %752, i64 128
  %758 = load <8 x double>, ptr %757, align 64
  %759 = fmul contract <8 x double> %730, %758
  %760 = fmul contract <8 x double> %734, %756
  %761 = fadd contract <8 x double> %760, %759
  %762 = fmul contract <8 x double> %738, %754
  %763 = fadd contract <8 x double> %762, %761
  br label %764

764:
  %765 = phi contract <8 x double> [ %763, %751 ], [ zeroinitializer, %744 ]
  %766 = load i64, ptr %0, align 64
  %767 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %297, i64 0, i64 %766, i64 %745
  store <8 x double> %765, ptr %767, align 64
  %768 = icmp eq i64 %746, %8
  br i1 %768, label %769, label %744

769:
  %770 = load i64, ptr %0, align 64
  %771 = add nsw i64 %770, 1
  store i64 %771, ptr %0, align 64
  %772 = add nuw nsw i64 %724, 1
  %773 = icmp eq i64 %772, 3
  br i1 %773, label %721, label %722

774:
  %775 = fmul contract double %717, 4.500000e-01
  %776 = fadd contract double %775, 0.000000e+00
  %777 = insertelement <8 x double> poison, double %776, i64 0
  %778 = shufflevector <8 x double> %777, <8 x double> poison, <8 x i32> zeroinitializer
  %779 = fmul contract <8 x double> %778, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %780 = fadd contract <8 x double> %779, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %781 = fadd contract <8 x double> %780, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %782 = fmul contract <8 x double> %781, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %783 = fsub contract <8 x double> %778, %782
  %784 = fmul contract <8 x double> %781, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %785 = fsub contract <8 x double> %783, %784
  %786 = fmul contract <8 x double> %781, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %787 = fsub contract <8 x double> %785, %786
  %788 = fmul contract <8 x double> %781, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %789 = fadd contract <8 x double> %788, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %790 = fadd contract <8 x double> %789, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %791 = fsub contract <8 x double> %788, %790
  %792 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %791)
  %793 = fmul contract <8 x double> %792, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %794 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %793
  %795 = fmul contract <8 x double> %787, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %796 = fmul contract <8 x double> %795, %795
  %797 = fmul contract <8 x double> %795, %796
  %798 = fmul contract <8 x double> %796, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %799 = fadd contract <8 x double> %798, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %800 = fmul contract <8 x double> %796, %799
  %801 = fadd contract <8 x double> %800, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %802 = fmul contract <8 x double> %796, %801
  %803 = fadd contract <8 x double> %802, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %804 = fmul contract <8 x double> %796, %803
  %805 = fadd contract <8 x double> %804, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %806 = fmul contract <8 x double> %796, %805
  %807 = fadd contract <8 x double> %806, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %808 = fmul contract <8 x double> %797, %807
  %809 = fadd contract <8 x double> %795, %808
  %810 = fmul contract <8 x double> %796, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %811 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %810
  %812 = fmul contract <8 x double> %796, %796
  %813 = fmul contract <8 x double> %796, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %814 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %813
  %815 = fmul contract <8 x double> %796, %814
  %816 = fadd contract <8 x double> %815, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %817 = fmul contract <8 x double> %796, %816
  %818 = fadd contract <8 x double> %817, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %819 = fmul contract <8 x double> %796, %818
  %820 = fadd contract <8 x double> %819, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %821 = fmul contract <8 x double> %796, %820
  %822 = fadd contract <8 x double> %821, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %823 = fmul contract <8 x double> %812, %822
  %824 = fadd contract <8 x double> %811, %823
  %825 = fmul contract <8 x double> %794, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %826 = fmul contract <8 x double> %825, %809
  %827 = fmul contract <8 x double> %824, %826
  %828 = fadd contract double %717, -1.000000e-09
  %829 = fmul contract double %828, 5.000000e-01
  %830 = fadd contract double %829, 0.000000e+00
  %831 = insertelement <8 x double> poison, double %830, i64 0
  %832 = shufflevector <8 x double> %831, <8 x double> poison, <8 x i32> zeroinitializer
  %833 = fmul contract <8 x double> %832, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %834 = fadd contract <8 x double> %833, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %835 = fadd contract <8 x double> %834, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %836 = fmul contract <8 x double> %835, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %837 = fsub contract <8 x double> %832, %836
  %838 = fmul contract <8 x double> %835, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %839 = fsub contract <8 x double> %837, %838
  %840 = fmul contract <8 x double> %835, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %841 = fsub contract <8 x double> %839, %840
  %842 = fmul contract <8 x double> %835, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %843 = fadd contract <8 x double> %842, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %844 = fadd contract <8 x double> %843, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %845 = fsub contract <8 x double> %842, %844
  %846 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %845)
  %847 = fmul contract <8 x double> %846, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %848 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %847
  %849 = fmul contract <8 x double> %841, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %850 = fmul contract <8 x double> %849, %849
  %851 = fmul contract <8 x double> %849, %850
  %852 = fmul contract <8 x double> %850, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %853 = fadd contract <8 x double> %852, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %854 = fmul contract <8 x double> %850, %853
  %855 = fadd contract <8 x double> %854, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %856 = fmul contract <8 x double> %850, %855
  %857 = fadd contract <8 x double> %856, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %858 = fmul contract <8 x double> %850, %857
  %859 = fadd contract <8 x double> %858, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %860 = fmul contract <8 x double> %850, %859
  %861 = fadd contract <8 x double> %860, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %862 = fmul contract <8 x double> %851, %861
  %863 = fadd contract <8 x double> %849, %862
  %864 = fmul contract <8 x double> %850, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %865 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %864
  %866 = fmul contract <8 x double> %850, %850
  %867 = fmul contract <8 x double> %850, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %868 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %867
  %869 = fmul contract <8 x double> %850, %868
  %870 = fadd contract <8 x double> %869, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %871 = fmul contract <8 x double> %850, %870
  %872 = fadd contract <8 x double> %871, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %873 = fmul contract <8 x double> %850, %872
  %874 = fadd contract <8 x double> %873, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %875 = fmul contract <8 x double> %850, %874
  %876 = fadd contract <8 x double> %875, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %877 = fmul contract <8 x double> %866, %876
  %878 = fadd contract <8 x double> %865, %877
  %879 = fmul contract <8 x double> %848, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %880 = fmul contract <8 x double> %879, %863
  %881 = fmul contract <8 x double> %878, %880
  %882 = fmul contract <8 x double> %881, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %883 = fcmp contract ogt <8 x double> %686, %882
  %884 = fmul contract <8 x double> %686, <double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01, double 2.500000e-01>
  %885 = fmul contract <8 x double> %686, %884
  %886 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %885
  %887 = fcmp contract ogt <8 x double> %886, <double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02>
  %888 = select contract <8 x i1> %887, <8 x double> %886, <8 x double> <double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02, double 1.000000e-02>
  %889 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %888)
  %890 = select contract <8 x i1> %883, <8 x double> %715, <8 x double> zeroinitializer
  %891 = fmul contract <8 x double> %827, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %892 = fsub contract <8 x double> %686, %891
  %893 = fdiv contract <8 x double> %892, %889
  %894 = select contract <8 x i1> %883, <8 x double> %893, <8 x double> zeroinitializer
  %895 = fmul contract <8 x double> %703, %890
  %896 = fmul contract <8 x double> %705, %890
  %897 = fmul contract <8 x double> %708, %890
  %898 = load i64, ptr %0, align 64
  %899 = getelementptr inbounds [24 x <8 x double>], ptr %296, i64 0, i64 %898
  store <8 x double> %894, ptr %899, align 64
  br i1 %24, label %900, label %925

900:
  %901 = phi i64 [ %902, %920 ], [ 0, %774 ]
  %902 = add nuw nsw i64 %901, 1
  %903 = load ptr, ptr %298, align 8
  %904 = getelementptr inbounds double, ptr %903, i64 %901
  %905 = load double, ptr %904, align 8
  %906 = fcmp contract oeq double %905, 0.000000e+00
  br i1 %906, label %920, label %907

907:
  %908 = getelementptr inbounds [65 x %struct.Frame.3], ptr %5, i64 0, i64 %902
  %909 = getelementptr inbounds i8, ptr %908, i64 512
  %910 = load <8 x double>, ptr %909, align 64
  %911 = getelementptr inbounds i8, ptr %908, i64 320
  %912 = load <8 x double>, ptr %911, align 64
  %913 = getelementptr inbounds i8, ptr %908, i64 128
  %914 = load <8 x double>, ptr %913, align 64
  %915 = fmul contract <8 x double> %895, %914
  %916 = fmul contract <8 x double> %896, %912
  %917 = fadd contract <8 x double> %916, %915
  %918 = fmul contract <8 x double> %897, %910
  %919 = fadd contract <8 x double> %918, %917
  br label %920

920:
  %921 = phi contract <8 x double> [ %919, %907 ], [ zeroinitializer, %900 ]
  %922 = load i64, ptr %0, align 64
  %923 = getelementptr inbounds [24 x [64 x <8 x double>]], ptr %297, i64 0, i64 %922, i64 %901
  store <8 x double> %921, ptr %923, align 64
  %924 = icmp eq i64 %902, %8
  br i1 %924, label %925, label %900

925:
  %926 = load i64, ptr %0, align 64
  %927 = add nsw i64 %926, 1
  store i64 %927, ptr %0, align 64
  br label %928

928:
  %929 = fcmp contract ogt <8 x double> %697, zeroinitializer
  %930 = select contract <8 x i1> %929, <8 x double> %697, <8 x double> <double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A, double 0x6974E718D7D7625A>
  %931 = getelementptr inbounds [24 x <8 x double>], ptr %299, i64 0, i64 %428
  store <8 x double> %930, ptr %931, align 64
  %932 = load i64, ptr %0, align 64
  %933 = getelementptr inbounds [24 x i64], ptr %300, i64 0, i64 %428
  store i64 %932, ptr %933, align 8
  %934 = fsub contract <8 x double> <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>, %692
  %935 = select contract <8 x i1> %929, <8 x double> %692, <8 x double> %934
  br label %936

936:
  %937 = phi <8 x double> [ %935, %928 ], [ %553, %540 ]
  %938 = add nsw i64 %428, 1
  %939 = getelementptr inbounds [24 x <8 x double>], ptr %301, i64 0, i64 %428
  store <8 x double> %937, ptr %939, align 64
  br label %940

940:
  %941 = phi i64 [ %428, %625 ], [ %938, %936 ]
  %942 = add nuw nsw i64 %309, 1
  %943 = load i64, ptr %291, align 8
  %944 = icmp slt i64 %942, %943
  br i1 %944, label %307, label %306
}

declare float @llvm.sqrt.f32(float)

declare float @llvm.vector.reduce.fmax.v16f32(<16 x float>)

declare i64 @llvm.cttz.i64(i64, i1 immarg)

declare i64 @llvm.smin.i64(i64, i64)

declare i64 @llvm.umax.i64(i64, i64)



